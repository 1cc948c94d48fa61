// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <Inventor/SbMatrix.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/errors/SoMemoryError.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShape.h>
#include <Inventor/nodes/SoShapeHints.h>

#include <mutex>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/model_io/graspit_io.hpp"
#include "model_io/text_values.hpp"

namespace eigengrasp {

namespace {

/// Coin is one per process and not made for threads: readers take turns. Its messages are collected here
/// instead of printed.
struct CoinGuard {
  std::mutex mutex;
  std::string first_message;
};

CoinGuard& coin() {
  static CoinGuard guard;
  return guard;
}

void keep_message(const SoError* error, void*) {
  if (coin().first_message.empty()) coin().first_message = error->getDebugString().getString();
}

void drop_message(const SoError*, void*) {}

void start_coin() {
  static std::once_flag once;
  std::call_once(once, [] {
    SoDB::init();
    SoError::setHandlerCallback(drop_message, nullptr);
    SoDebugError::setHandlerCallback(drop_message, nullptr);
    SoMemoryError::setHandlerCallback(drop_message, nullptr);
    SoReadError::setHandlerCallback(keep_message, nullptr);
  });
}

/// A node that is released at the end of the scope.
class NodeRef {
 public:
  explicit NodeRef(SoSeparator* node) : node_(node) {
    if (node_) node_->ref();
  }
  ~NodeRef() {
    if (node_) node_->unref();
  }
  NodeRef(const NodeRef&) = delete;
  NodeRef& operator=(const NodeRef&) = delete;
  SoSeparator* get() const { return node_; }

 private:
  SoSeparator* node_;
};

struct Collector {
  TriangleMesh mesh;
  double scale = 1.0;
};

void add_triangle(void* data, SoCallbackAction* action, const SoPrimitiveVertex* v1,
                  const SoPrimitiveVertex* v2, const SoPrimitiveVertex* v3) {
  auto& out = *static_cast<Collector*>(data);
  const SbMatrix& to_world = action->getModelMatrix();
  const auto first = static_cast<std::int32_t>(out.mesh.vertices.size());
  for (const SoPrimitiveVertex* v : {v1, v2, v3}) {
    SbVec3f p;
    to_world.multVecMatrix(v->getPoint(), p);
    out.mesh.vertices.push_back(out.scale * Vec3(p[0], p[1], p[2]));
  }
  // A mirroring transform turns the triangle's other side outwards, as clockwise vertices do.
  const bool clockwise = action->getVertexOrdering() == SoShapeHints::CLOCKWISE;
  if (clockwise != (to_world.det3() < 0.0f)) {
    out.mesh.triangles.push_back({first, first + 2, first + 1});
  } else {
    out.mesh.triangles.push_back({first, first + 1, first + 2});
  }
}

}  // namespace

TriangleMesh load_inventor(const std::filesystem::path& file, double scale) {
  std::error_code ec;
  if (!std::filesystem::is_regular_file(file, ec)) {
    fail_at(file, 0, "is missing or not a file, expected an Open Inventor or VRML file");
  }
  start_coin();
  const std::lock_guard lock(coin().mutex);
  coin().first_message.clear();
  SoInput in;
  if (!in.openFile(file.c_str(), TRUE)) fail_at(file, 0, "cannot be read");
  const NodeRef root(in.isValidFile() ? SoDB::readAll(&in) : nullptr);
  if (!root.get()) {
    const std::string reason = coin().first_message.empty() ? "no known header" : shown(coin().first_message);
    fail_at(file, 0, "cannot be parsed as Open Inventor or VRML ({})", reason);
  }
  Collector collector{{}, scale};
  SoCallbackAction action;
  action.addTriangleCallback(SoShape::getClassTypeId(), add_triangle, &collector);
  action.apply(root.get());
  for (const Vec3& p : collector.mesh.vertices)
    if (!p.allFinite()) fail_at(file, 0, "has a vertex that is not a finite number");
  weld(collector.mesh, 0.0);
  if (collector.mesh.empty()) fail_at(file, 0, "holds no triangle, expected a surface");
  return std::move(collector.mesh);
}

}  // namespace eigengrasp
