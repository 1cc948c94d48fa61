// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

namespace eigengrasp::server {

/// The calling thread, and those that it starts from now on, give way to the others where processors are
/// short: searches take all that is left, and whoever waits for an answer is served at once.
void give_way();

}  // namespace eigengrasp::server
