// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/experiments/reference_figures.hpp"

namespace eigengrasp {

namespace {

using Row = std::array<double, kPaperObjects.size()>;
using Figures = std::array<Row, kPaperHands.size()>;

// ashtray, shoe, glass, flask, phone, plane
constexpr Figures paper{{{2.8, 1.0, 5.8, 3.4, 1.4, 4.0},
                         {11.0, 6.0, 0.8, 3.2, 2.8, 1.8},
                         {7.0, 9.0, 14.4, 14.4, 10.0, 3.6},
                         {14.6, 11.0, 11.2, 13.4, 8.4, 1.8}}};
constexpr Figures graspit{{{0.0, 0.6, 0.8, 0.2, 0.0, 0.0},
                           {10.4, 11.8, 0.4, 6.2, 0.6, 2.6},
                           {11.2, 6.3, 11.5, 9.5, 5.5, 3.0},
                           {16.3, 9.3, 7.3, 13.7, 7.7, 2.0}}};
constexpr std::array state_seconds{0.15e-3, 0.15e-3, 0.46e-3, 0.21e-3};

double figure(const Figures& figures, PaperHand hand, PaperObject object) {
  return figures.at(static_cast<std::size_t>(hand)).at(static_cast<std::size_t>(object));
}

}  // namespace

double paper_form_closed(PaperHand hand, PaperObject object) {
  return figure(paper, hand, object);
}

double graspit_form_closed(PaperHand hand, PaperObject object) {
  return figure(graspit, hand, object);
}

double graspit_state_seconds(PaperHand hand) {
  return state_seconds.at(static_cast<std::size_t>(hand));
}

}  // namespace eigengrasp
