// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/json_lines.hpp"
#include "cli/scene_options.hpp"
#include "cli/shape_files.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/model_io/model_library.hpp"
#include "eigengrasp/shape/nearest_shapes.hpp"
#include "eigengrasp/shape/shape_alignment.hpp"

namespace eigengrasp::cli {

namespace {

/// What the commands are told.
struct ShapeChoice {
  std::vector<std::string> shapes;  ///< of align: the model and the target
  std::vector<std::string> among;
  ShapeReading reading;
  int count = 5;
  std::string method = kIcpAlignment;
  bool keep_scale = false, one_sided = false, json = false;
};

void print_descriptors(const ShapeChoice& choice) {
  const auto all = describe_shapes(choice.shapes, choice.reading);
  if (!choice.json)
    fmt::print("{:<24} {:<8} {:<8} {:>10}  {}\n", "shape", "of the", "by", "radius mm",
               "F00 F11 F20 F22 F31 F33");
  for (const NamedDescriptor& named : all) {
    if (choice.json) {
      print_line(descriptor_json(named));
      continue;
    }
    const ShapeDescriptor& d = named.descriptor;
    fmt::print("{:<24} {:<8} {:<8} {:>10.1f} ", named.name, to_string(d.function), to_string(d.route),
               1e3 * d.ball.radius);
    for (int i = 0; i < 6; ++i) fmt::print(" {:.5f}", d.invariants[static_cast<std::size_t>(i)]);
    fmt::print("\n");
  }
}

std::vector<std::string> shipped_objects() {
  std::vector<std::string> names;
  for (const NamedModel& model : list_objects()) names.push_back(model.name);
  return names;
}

void print_neighbors(const ShapeChoice& choice) {
  if (choice.count < 1) fail("--count is {}, expected 1 or more", choice.count);
  const auto queries = describe_shapes(choice.shapes, choice.reading);
  const auto among = describe_shapes(choice.among.empty() ? shipped_objects() : choice.among, choice.reading);
  NearestShapes shapes(kDescriptorSize);
  for (const NamedDescriptor& named : among) shapes.add(named.descriptor.values);
  for (const NamedDescriptor& query : queries) {
    nlohmann::ordered_json line{{"name", query.name}, {"neighbors", nlohmann::ordered_json::array()}};
    if (!choice.json) fmt::print("{}\n", query.name);
    for (const NearShape& near :
         shapes.find_nearest(query.descriptor.values, static_cast<std::size_t>(choice.count))) {
      line["neighbors"].push_back({{"name", among[near.index].name}, {"distance", near.distance}});
      if (!choice.json) fmt::print("  {:<24} {:.4f}\n", among[near.index].name, near.distance);
    }
    if (choice.json) print_line(line);
  }
}

AlignmentShape alignment_shape(const std::string& name, const std::string& units) {
  ObjectReadOptions options;
  options.units = units;
  return make_alignment_shape(load_sound_object(find_object(name), options).mesh);
}

void print_alignment(const ShapeChoice& choice) {
  if (choice.method != kPcaAlignment && choice.method != kIcpAlignment)
    fail("--method is '{}', expected {} or {}", choice.method, kPcaAlignment, kIcpAlignment);
  AlignmentOptions options;
  options.match_scale = !choice.keep_scale;
  options.one_sided = choice.one_sided;
  const AlignmentShape model = alignment_shape(choice.shapes[0], choice.reading.units);
  const AlignmentShape target = alignment_shape(choice.shapes[1], choice.reading.units);
  const Alignment a = choice.method == kPcaAlignment ? align_by_pca(model, target, options)
                                                     : align_by_icp(model, target, options);
  const Eigen::Matrix4d X = a.matrix(a.scale);
  if (choice.json) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (int i = 0; i < 4; ++i) rows.push_back({X(i, 0), X(i, 1), X(i, 2), X(i, 3)});
    return print_line({{"model", choice.shapes[0]},
                       {"target", choice.shapes[1]},
                       {"method", a.method},
                       {"X_target_model", rows},
                       {"scale", a.scale},
                       {"overlap", a.overlap},
                       {"distance", a.distance}});
  }
  for (int i = 0; i < 4; ++i)
    fmt::print("{:10.6f} {:10.6f} {:10.6f} {:10.6f}\n", X(i, 0), X(i, 1), X(i, 2), X(i, 3));
  fmt::print("method {}, scale {:.4f}, overlap {:.3f}, distance {:.1f} % of the target's size\n", a.method,
             a.scale, a.overlap, 100.0 * a.distance);
}

void add_reading(CLI::App& command, ShapeChoice& choice, bool described) {
  command.add_option("--units", choice.reading.units,
                     "Of the meshes: m, cm, mm, in (GraspIt! files: mm, else m)");
  if (described) {
    command
        .add_option("--function", choice.reading.function, "surface (any mesh) or solid (what it encloses)")
        ->capture_default_str();
    command.add_option("--threads", choice.reading.threads, "0: all; does not change the result");
  }
  command.add_flag("--json", choice.json, "JSON, one object a line, instead of a table");
}

const char* const kShapesHelp =
    "Shipped objects' names, mesh files, folders of meshes, or .jsonl files that 'shape describe --json' "
    "wrote";

void add_describe(CLI::App& shape, const std::shared_ptr<ShapeChoice>& choice) {
  CLI::App* command = shape.add_subcommand("describe", "3-D Zernike descriptors: 121 numbers a shape");
  command->add_option("shapes", choice->shapes, kShapesHelp)->required();
  add_reading(*command, *choice, true);
  command->footer(
      "Examples:\n"
      "  eigengrasp shape describe flask part.stl --units mm\n"
      "  eigengrasp shape describe meshes --json > meshes.jsonl");
  command->callback([choice] { print_descriptors(*choice); });
}

void add_neighbors(CLI::App& shape, const std::shared_ptr<ShapeChoice>& choice) {
  CLI::App* command = shape.add_subcommand("neighbors", "The shapes that are most like a shape");
  command->add_option("shapes", choice->shapes, kShapesHelp)->required()->expected(1);
  command->add_option("--among", choice->among,
                      std::string("What to search (default: the shipped objects). ") + kShapesHelp);
  command->add_option("--count", choice->count, "How many")->capture_default_str();
  add_reading(*command, *choice, true);
  command->footer(
      "Examples:\n"
      "  eigengrasp shape neighbors part.stl --units mm --count 3\n"
      "  eigengrasp shape neighbors flask --among meshes.jsonl --json");
  command->callback([choice] { print_neighbors(*choice); });
}

void add_align(CLI::App& shape, const std::shared_ptr<ShapeChoice>& choice) {
  CLI::App* command = shape.add_subcommand("align", "The pose (and scale) that lays one shape upon another");
  command->add_option("shapes", choice->shapes, "The shape that is moved, and the target")
      ->required()
      ->expected(2);
  command->add_option("--method", choice->method, "pca, or pca-icp (refined by iterative closest points)")
      ->capture_default_str();
  command->add_flag("--keep-scale", choice->keep_scale, "Both keep their sizes");
  command->add_flag("--one-sided", choice->one_sided, "The moved shape may be a part of the target");
  add_reading(*command, *choice, false);
  command->footer(
      "Prints X_target_model, 4 x 4, translation in m.\n"
      "Examples:\n"
      "  eigengrasp shape align glass flask\n"
      "  eigengrasp shape align scan.ply part.stl --method pca --keep-scale --json");
  command->callback([choice] { print_alignment(*choice); });
}

}  // namespace

void add_shape_command(CLI::App& app) {
  CLI::App* shape = app.add_subcommand("shape", "Describe shapes, find like ones, lay one upon another");
  shape->require_subcommand(1);
  shape->footer(
      "Examples:\n"
      "  eigengrasp shape describe flask\n"
      "  eigengrasp shape neighbors flask\n"
      "  eigengrasp shape align glass flask");
  const auto choice = std::make_shared<ShapeChoice>();
  add_describe(*shape, choice);
  add_neighbors(*shape, choice);
  add_align(*shape, choice);
}

}  // namespace eigengrasp::cli
