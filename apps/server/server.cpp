// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/server.hpp"

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "server/api.hpp"
#include "server/client_front.hpp"
#include "server/network.hpp"
#include "server/session_hub.hpp"
#include "server/web_address.hpp"

namespace eigengrasp::server {

namespace {

std::string url_of(const std::string& bind, int port) {
  if (bind == "0.0.0.0" || bind == "::" || bind == "localhost")
    return fmt::format("http://127.0.0.1:{}/", port);
  if (bind.find(':') != std::string::npos) return fmt::format("http://[{}]:{}/", bind, port);
  return fmt::format("http://{}:{}/", bind, port);
}

}  // namespace

void serve(const ServerOptions& options, std::shared_ptr<PreparationCache> files, const WhenReady& ready) {
  if (const auto violations = options.validate(); !violations.empty()) fail("{}", violations.front());
  if (!options.logs.empty()) require_writable_folder(options.logs);
  const auto folder = options.app.empty() ? find_app_folder() : options.app;
  StaticFiles app = folder.empty() ? StaticFiles() : StaticFiles(folder);
  const bool has_app = !app.empty();

  Services services(options, std::move(files));
  SessionHub hub(services);
  Api api(services, std::move(app));
  NetworkHandlers handlers;
  handlers.admit = [&](const HttpRequest& request) { return api.admit(request); };
  handlers.takes_body = [&](const HttpRequest& request) { return api.takes_body(request); };
  handlers.answer = [&](const HttpRequest& request) { return api.answer(request); };
  handlers.connected = [&](std::shared_ptr<Client> client) -> std::shared_ptr<ClientHandler> {
    return std::make_shared<ClientFront>(services, hub, std::move(client));
  };
  handlers.datagram = [&](std::string_view text) { hub.take_datagram(text); };

  const auto network = std::make_shared<Network>(options, std::move(handlers));
  ready({network->port(), url_of(options.bind, network->port()), network->udp_port(), has_app},
        [running = std::weak_ptr(network)] {
          if (const auto still = running.lock()) still->stop();
        });
  network->run();
  hub.end_all();
  services.background.wait_for_all();  // before the network goes, which its clients refer to
}

}  // namespace eigengrasp::server
