// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "database/retrying_store.hpp"
#include "database/sql_store.hpp"
#include "database/text_store.hpp"
#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

std::unique_ptr<GraspStore> open_store(const std::string& address, const StoreOptions& options) {
  const auto after = [&](const std::string& scheme) { return address.substr(scheme.size()); };
  if (address.starts_with("sqlite:") && address.size() > 7)
    return std::make_unique<SqlStore>(open_sqlite(after("sqlite:"), options), options.access);
  if (address.starts_with("text:") && address.size() > 5)
    return std::make_unique<TextStore>(after("text:"), options);
  if (address.starts_with("postgresql://") || address.starts_with("postgres://"))
    return std::make_unique<RetryingStore>(
        [&] { return std::make_unique<SqlStore>(open_postgres(address, options), options.access); }, options);
  fail(
      "'{}' is no address of a grasp store; expected sqlite:FILE, text:FOLDER or "
      "postgresql://USER:PASSWORD@HOST/DATABASE",
      address.substr(0, 100));
}

}  // namespace eigengrasp
