// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "experiments/record_json.hpp"

namespace eigengrasp {

OrderedJson record_json(const ExperimentRecord& record) {
  const Machine& m = record.machine;
  OrderedJson machine{{"processor", m.processor}, {"threads", m.threads}, {"memory_bytes", m.memory}};
  if (!m.instruction_set.empty()) machine["instruction_set"] = m.instruction_set;
  return {{"command", record.command}, {"program_version", record.version}, {"machine", machine}};
}

}  // namespace eigengrasp
