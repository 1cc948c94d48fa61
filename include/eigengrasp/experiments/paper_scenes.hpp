// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "eigengrasp/grasp/scene.hpp"
#include "eigengrasp/model_io/paper_models.hpp"

namespace eigengrasp {

/// What the contacts' friction is; the paper does not say which it used.
enum class FrictionCase {
  materials,  ///< as the models' materials say
  one,        ///< mu = 1 everywhere
};

/// Hands and objects, each loaded once.
class PaperScenes {
 public:
  PaperScenes(const ModelSource& source, const std::vector<PaperHand>& hands,
              const std::vector<PaperObject>& objects, const LogSink& log = {});

  /// @pre both were loaded
  Scene scene(PaperHand hand, PaperObject object, FrictionCase friction) const;

 private:
  std::map<PaperHand, std::shared_ptr<const HandModel>> hands_;
  std::map<PaperObject, std::shared_ptr<const ObjectModel>> objects_;
};

}  // namespace eigengrasp
