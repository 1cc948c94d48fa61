// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "cli/db_parts.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/model_io/model_library.hpp"

namespace eigengrasp::cli {

namespace {

constexpr const char* kShipped = "shipped";

StoreOptions options_of(StoreAccess access) {
  StoreOptions options;
  options.access = access;
  options.log = warn;
  return options;
}

}  // namespace

std::unique_ptr<GraspStore> open_to_read(const std::string& address) {
  return open_store(address == kShipped ? "sqlite:" + find_shipped_grasps().string() : address,
                    options_of(StoreAccess::read));
}

std::unique_ptr<GraspStore> open_to_write(const std::string& address, bool await_server) {
  if (address == kShipped)
    fail(
        "'shipped' is only for reading; 'eigengrasp db export shipped sqlite:FILE' makes a copy to write to");
  StoreOptions options = options_of(StoreAccess::write);
  options.await_server = await_server;
  return open_store(address, options);
}

}  // namespace eigengrasp::cli
