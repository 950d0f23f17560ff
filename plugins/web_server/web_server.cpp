#include "plugins/web_server/web_server.h"

#include <optional>
#include <thread>
#include <utility>

#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include "core/base/retry.h"
#include "plugins/web_server/access_rules.h"
#include "plugins/web_server/internal/beast_connections.h"

namespace runnel {

namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using internal::ConnectionRegistry;
using internal::TlsIdentity;

// After accepting has failed, for want of descriptors.
constexpr auto kPause = std::chrono::milliseconds(100);
// Of what has not been sent yet so much waits in a socket: with more, one that is taken from slowly would be full for so long that
// its client is thought to take nothing, and a ping would be late.
constexpr int kUnsent = 32 * 1024;
// For clients to answer that the server ends.
constexpr auto kFarewell = std::chrono::milliseconds(200);

Error CannotListen(const WebServerOptions& options, const boost::system::error_code& why) {
  const std::string place = options.address + ":" + std::to_string(options.port);
  if (why == asio::error::address_in_use) {
    return {
        .message = "port " + std::to_string(options.port) + " of " + options.address + " is taken by another program",
        .hint = "choose another one, or 0 for any that is free"};
  }
  if (why == asio::error::access_denied) {
    return {.message = "port " + std::to_string(options.port) + " may not be used: " + why.message(),
            .hint = "choose one from 1024 on, or 0 for any that is free"};
  }
  if (why == boost::system::errc::address_not_available) {
    return {.message = options.address + " is no address of this machine",
            .hint = "write 127.0.0.1 for this machine only, or 0.0.0.0 for all networks"};
  }
  return {.message = "cannot listen to " + place + ": " + why.message()};
}

// 0.0.0.0 stands for all addresses, and is none to open.
std::string UrlOf(const WebServerOptions& options, std::uint16_t port) {
  std::string host = options.address;
  if (host == "0.0.0.0" || host == "::") host = asio::ip::host_name();
  if (host.find(':') != std::string::npos) host = "[" + host + "]";
  return (options.certificate_file.empty() ? "http://" : "https://") + host + ":" + std::to_string(port) + "/";
}

// The token that is made where one is needed and there is none; "" elsewhere. Errors: the address is
// none, or none to serve in the clear.
Result<std::string> TokenFor(const WebServerOptions& options) {
  const auto is_loopback = IsLoopback(options.address);
  if (!is_loopback) return is_loopback.error();
  if (*is_loopback) return std::string();
  if (options.certificate_file.empty() && !options.is_insecure) {
    return Error{.message = "at " + options.address +
                            " others on the network could read along and take part: nothing is encrypted",
                 .hint =
                     "give it a certificate (--inspect-certificate, --inspect-key); "
                     "--inspect-insecure where nobody else listens, or a proxy encrypts"};
  }
  if (!options.tokens.empty()) return std::string();
  return MakeToken();
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

class Running final : public WebServer {
 public:
  Running(std::unique_ptr<ConnectionRegistry> registry, std::shared_ptr<TlsIdentity> identity, tcp::acceptor acceptor,
          std::string url, std::string made_token)
      : registry_(std::move(registry)),
        identity_(std::move(identity)),
        acceptor_(std::move(acceptor)),
        pause_(registry_->context()),
        url_(std::move(url)),
        made_token_(std::move(made_token)),
        port_(acceptor_.local_endpoint().port()),
        thread_([this] {
          Accept();
          Run();
        }) {}

  ~Running() override {
    const bool is_told =
        Retry([this] { asio::post(registry_->context(), [this] { OrStop([this] { SayFarewell(); }); }); });
    if (!is_told) registry_->context().stop();
    thread_.join();
    registry_->Clear();
  }

  [[nodiscard]] const std::string& url() const noexcept override { return url_; }
  [[nodiscard]] const std::string& made_token() const noexcept override { return made_token_; }
  [[nodiscard]] std::uint16_t port() const noexcept override { return port_; }
  [[nodiscard]] std::size_t clients() const noexcept override { return registry_->sessions(); }

 private:
  // Beneath this nobody catches anything. What throws, for want of memory, has lost the connection that it belongs to,
  // or is none.
  void Run() noexcept {
    for (;;) {
      try {
        registry_->context().run();
        return;
      } catch (...) {
        registry_->RemoveLost();
        AcceptAnew();
      }
    }
  }
  // Asio may have thrown before it called who accepts, who would be gone.
  void AcceptAnew() noexcept {
    if (!acceptor_.is_open()) return;
    boost::system::error_code ignored;
    pause_.cancel(ignored);
    acceptor_.cancel(ignored);
    Accept();
  }
  template <typename Do>
  void OrStop(const Do& act) noexcept {
    try {
      act();
    } catch (...) {
      registry_->context().stop();
    }
  }

  void Accept() noexcept {
    while (acceptor_.is_open() && !registry_->context().stopped()) {
      try {
        return BeginToAccept();
      } catch (...) {  // else nobody would be accepted any more
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
  }

  void BeginToAccept() {
    acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
      if (!acceptor_.is_open() || error == asio::error::operation_aborted) return;
      if (!error) {
        Serve(std::move(socket));
        return Accept();
      }
      if (error == asio::error::connection_aborted) return Accept();
      Pause();
    });
  }

  void Pause() noexcept {
    try {
      pause_.expires_after(kPause);
      pause_.async_wait([this](boost::system::error_code cancelled) {
        if (!cancelled) Accept();
      });
    } catch (...) {
      Accept();
    }
  }

  // Or lets it go.
  void Serve(tcp::socket socket) noexcept {
    try {
      boost::system::error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      (void)setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kUnsent, sizeof kUnsent);
      std::optional<std::uint32_t> user;
      if (registry_->rules().AsksForUser()) user = internal::UserOfPeer(socket);
      if (identity_ != nullptr) {
        internal::ServeTls(*registry_, identity_, std::move(socket), user);
      } else {
        internal::ServeHttp(*registry_, std::move(socket), user);
      }
    } catch (...) {  // for want of memory
    }
  }

  void SayFarewell() {
    boost::system::error_code ignored;
    acceptor_.close(ignored);
    pause_.cancel();
    registry_->ForEach([](internal::WebConnection& each) { each.End("the application has ended"); });
    auto timer = std::make_shared<asio::steady_timer>(registry_->context(), kFarewell);
    AwaitEnd(std::move(timer), std::chrono::steady_clock::now() + kFarewell);
  }

  void AwaitEnd(std::shared_ptr<asio::steady_timer> timer, std::chrono::steady_clock::time_point end) {
    if (registry_->connections() == 0 || std::chrono::steady_clock::now() >= end) {
      return registry_->context().stop();
    }
    timer->expires_after(std::chrono::milliseconds(2));
    timer->async_wait([this, timer, end](boost::system::error_code) { OrStop([&] { AwaitEnd(timer, end); }); });
  }

  const std::unique_ptr<ConnectionRegistry> registry_;
  const std::shared_ptr<TlsIdentity> identity_;  // nullptr: nothing is encrypted
  tcp::acceptor acceptor_;
  asio::steady_timer pause_;
  const std::string url_;
  const std::string made_token_;
  const std::uint16_t port_;
  std::thread thread_;
};

}  // namespace

Result<std::unique_ptr<WebServer>> WebServer::Start(WebServerOptions options, const std::vector<WebResource>& resources,
                                                    std::vector<WebProtocol> protocols) {
  auto made_token = TokenFor(options);
  if (!made_token) return made_token.error();
  if (!made_token->empty()) options.tokens.push_back({WebRole::kChange, *made_token});
  std::shared_ptr<TlsIdentity> identity;
  if (!options.certificate_file.empty() || !options.key_file.empty()) {
    auto loaded = internal::LoadTlsIdentity(options.certificate_file, options.key_file);
    if (!loaded) return loaded.error();
    identity = std::move(*loaded);
  }
  AccessRules rules(options);
  // It is listened to before there is a thread that serves.
  asio::io_context unused;
  auto probe = Listen(unused, options);
  if (!probe) return probe.error();
  const auto protocol = probe->local_endpoint().protocol();
  const std::string url = UrlOf(options, probe->local_endpoint().port());
  auto registry =
      std::make_unique<ConnectionRegistry>(std::move(options), std::move(rules), resources, std::move(protocols));
  tcp::acceptor acceptor(registry->context(), protocol, probe->release());
  return std::unique_ptr<WebServer>(std::make_unique<Running>(std::move(registry), std::move(identity),
                                                              std::move(acceptor), url, std::move(*made_token)));
}

}  // namespace runnel
