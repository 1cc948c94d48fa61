// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "eigengrasp/shape/shape_descriptor.hpp"

namespace eigengrasp::cli {

struct NamedDescriptor {
  std::string name;
  ShapeDescriptor descriptor;
};

/// How shapes are read and described.
struct ShapeReading {
  std::string units;
  std::string function = "surface";
  int threads = 0;
};

/// Describes shapes: names of shipped objects, mesh files, folders of them (with all below), and files of
/// descriptors (.jsonl), in this order. @throws Error for the first that is bad
std::vector<NamedDescriptor> describe_shapes(const std::vector<std::string>& shapes,
                                             const ShapeReading& reading);

/// {"name", "function", "route", "center", "radius", "invariants"}: a line of a file of descriptors.
nlohmann::ordered_json descriptor_json(const NamedDescriptor& named);

}  // namespace eigengrasp::cli
