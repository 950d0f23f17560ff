#include "plugins/web_server/web_server.h"

#include <optional>
#include <thread>
#include <utility>

#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "plugins/web_server/access_rules.h"
#include "plugins/web_server/internal/beast_connections.h"

namespace runnel {

namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using internal::ConnectionRegistry;
using internal::WebConnection;

// After accepting has failed, for want of descriptors.
constexpr auto kPause = std::chrono::milliseconds(100);
// For clients to answer that the server ends.
constexpr auto kFarewell = std::chrono::milliseconds(200);

Error CannotListen(const WebServerOptions& options, const boost::system::error_code& why) {
  const std::string place = options.address + ":" + std::to_string(options.port);
  if (why == asio::error::address_in_use) {
    return {.message = "port " + std::to_string(options.port) + " of " + options.address +
                       " is taken by another program",
            .hint = "choose another one, or 0 for any that is free"};
  }
  if (why == asio::error::access_denied) {
    return {
        .message = "port " + std::to_string(options.port) + " may not be used: " + why.message(),
        .hint = "choose one from 1024 on, or 0 for any that is free"};
  }
  if (why == boost::system::errc::address_not_available) {
    return {.message = options.address + " is no address of this machine",
            .hint = "write 127.0.0.1 for this machine only, or 0.0.0.0 for all networks"};
  }
  return {.message = "cannot listen to " + place + ": " + why.message()};
}

// 0.0.0.0 stands for all addresses, and is none to open.
std::string UrlOf(const std::string& address, std::uint16_t port, const std::string& token) {
  std::string host = address;
  if (address == "0.0.0.0" || address == "::") host = asio::ip::host_name();
  if (host.find(':') != std::string::npos) host = "[" + host + "]";
  return "http://" + host + ":" + std::to_string(port) + "/" +
         (token.empty() ? "" : "?token=" + token);
}

// With a token where one is needed. Errors: address or token are none.
Result<WebServerOptions> Completed(WebServerOptions options) {
  const auto is_loopback = IsLoopback(options.address);
  if (!is_loopback) return is_loopback.error();
  if (options.token.empty() && !*is_loopback) {
    auto token = MakeToken();
    if (!token) return token.error();
    options.token = std::move(*token);
  }
  if (!options.token.empty()) {
    if (auto checked = CheckToken(options.token); !checked) return checked.error();
  }
  return options;
}

// Before the thread that serves is there.
Result<tcp::acceptor> Listen(asio::io_context& context, const WebServerOptions& options) {
  boost::system::error_code error;
  const auto address = asio::ip::make_address(options.address, error);
  if (error) return CannotListen(options, error);
  const tcp::endpoint place(address, options.port);
  tcp::acceptor acceptor(context);
  acceptor.open(place.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(place, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) return CannotListen(options, error);
  return acceptor;
}

}  // namespace

class WebServer::Running {
 public:
  Running(std::unique_ptr<ConnectionRegistry> registry, tcp::acceptor acceptor, std::string url)
      : registry_(std::move(registry)),
        acceptor_(std::move(acceptor)),
        pause_(registry_->context()),
        url_(std::move(url)),
        port_(acceptor_.local_endpoint().port()),
        thread_([this] {
          Accept();
          registry_->context().run();
        }) {}

  ~Running() {
    asio::post(registry_->context(), [this] {
      boost::system::error_code ignored;
      acceptor_.close(ignored);
      pause_.cancel();
      registry_->ForEach([](WebConnection& each) { each.End("the application has ended"); });
      auto timer = std::make_shared<asio::steady_timer>(registry_->context(), kFarewell);
      AwaitEnd(std::move(timer), std::chrono::steady_clock::now() + kFarewell);
    });
    thread_.join();
    registry_->Clear();
  }

  [[nodiscard]] const std::string& url() const noexcept { return url_; }
  [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
  [[nodiscard]] std::size_t clients() const noexcept { return registry_->sessions(); }

 private:
  void Accept() {
    acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      if (!error) {
        boost::system::error_code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        internal::ServeHttp(*registry_, std::move(socket));
        return Accept();
      }
      if (error == asio::error::connection_aborted) return Accept();
      pause_.expires_after(kPause);
      pause_.async_wait([this](boost::system::error_code cancelled) {
        if (!cancelled) Accept();
      });
    });
  }

  void AwaitEnd(std::shared_ptr<asio::steady_timer> timer,
                std::chrono::steady_clock::time_point end) {
    if (registry_->connections() == 0 || std::chrono::steady_clock::now() >= end) {
      return registry_->context().stop();
    }
    timer->expires_after(std::chrono::milliseconds(2));
    timer->async_wait([this, timer, end](boost::system::error_code) { AwaitEnd(timer, end); });
  }

  const std::unique_ptr<ConnectionRegistry> registry_;
  tcp::acceptor acceptor_;
  asio::steady_timer pause_;
  const std::string url_;
  const std::uint16_t port_;
  std::thread thread_;
};

Result<std::unique_ptr<WebServer>> WebServer::Start(WebServerOptions options,
                                                    const std::vector<WebResource>& resources,
                                                    std::vector<WebProtocol> protocols) {
  auto completed = Completed(std::move(options));
  if (!completed) return completed.error();
  // The rules name the port, which is known only when it has been had.
  asio::io_context unused;
  auto probe = Listen(unused, *completed);
  if (!probe) return probe.error();
  const std::uint16_t port = probe->local_endpoint().port();
  const auto protocol = probe->local_endpoint().protocol();
  AccessRules rules(completed->token, completed->host_names, completed->origins, port);
  const std::string url = UrlOf(completed->address, port, completed->token);
  auto registry = std::make_unique<ConnectionRegistry>(std::move(*completed), std::move(rules),
                                                       resources, std::move(protocols));
  tcp::acceptor acceptor(registry->context(), protocol, probe->release());
  return std::unique_ptr<WebServer>(
      new WebServer(std::make_unique<Running>(std::move(registry), std::move(acceptor), url)));
}

WebServer::WebServer(std::unique_ptr<Running> running) : running_(std::move(running)) {}
WebServer::~WebServer() = default;

const std::string& WebServer::url() const noexcept { return running_->url(); }
std::uint16_t WebServer::port() const noexcept { return running_->port(); }
std::size_t WebServer::clients() const noexcept { return running_->clients(); }

}  // namespace runnel
