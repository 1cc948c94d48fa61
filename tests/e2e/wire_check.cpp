// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Says of each line on standard input whether it is sound by an entry of the schema: "ok", or the sentence
// that says why not. usage: wire_check DEFINITION
#include <iostream>
#include <string>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/wire/wire_text.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: wire_check DEFINITION\n";
    return 2;
  }
  for (std::string line; std::getline(std::cin, line);) {
    try {
      eigengrasp::wire::require_schema(line, argv[1]);
      std::cout << "ok\n";
    } catch (const eigengrasp::Error& e) {
      std::cout << e.what() << '\n';
    }
  }
}
