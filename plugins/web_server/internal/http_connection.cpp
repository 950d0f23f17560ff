#include <array>
#include <optional>
#include <utility>

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <boost/beast/http/serializer.hpp>
#include <boost/beast/http/span_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include "plugins/web_server/internal/beast_connections.h"

namespace runnel::internal {

namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using boost::asio::ip::tcp;

// What a client may still send after it has been refused, so that it comes to read why.
constexpr std::size_t kMostToDrain = 64 * 1024;
constexpr auto kTimeToDrain = std::chrono::seconds(1);

std::string_view View(beast::string_view text) { return {text.data(), text.size()}; }

WebRequest RequestOf(const HttpRequest& request) {
  return {.target = View(request.target()),
          .host = View(request[http::field::host]),
          .origin = View(request[http::field::origin]),
          .authorization = View(request[http::field::authorization]),
          .protocols = View(request[http::field::sec_websocket_protocol])};
}

// Which role somebody has is told to who asks for this.
constexpr std::string_view kAccessPath = "/access";

/// What browsers are to allow the page: its own files and this server, and no frame round it.
std::string ContentPolicy(const HttpRequest& request) {
  const std::string host(View(request[http::field::host]));
  return "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
         "font-src 'self'; worker-src 'self' blob:; connect-src 'self' ws://" +
         host + " wss://" + host + "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

/// One connection, request by request.
class HttpConnection final : public WebConnection, public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(ConnectionRegistry& registry, tcp::socket socket, std::optional<std::uint32_t> user,
                 std::shared_ptr<WebConnection> visitor)
      : WebConnection(std::nullopt),
        registry_(registry),
        user_(user),
        visitor_(std::move(visitor)),
        stream_(std::move(socket)) {}

  void Read() {
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(registry_.limits().header_bytes));
    parser_->body_limit(0);
    // Of the whole request, however many pieces it comes in.
    stream_.expires_after(registry_.limits().request_time);
    http::async_read(stream_, buffer_, *parser_, Handler(*this, &HttpConnection::OnRead));
  }

  void Remove() override {
    Cut();
    registry_.Remove(shared_from_this());
  }

  void Cut() noexcept override {
    beast::error_code ignored;
    stream_.socket().close(ignored);
  }

 private:
  void OnRead(beast::error_code error, std::size_t /*bytes*/) {
    if (!error) return Answer();
    request_ = {};
    if (error == http::error::header_limit || error == http::error::buffer_overflow) {
      return Refuse(http::status::request_header_fields_too_large, "the header is too long");
    }
    if (error == http::error::body_limit || error == http::error::unexpected_body) {
      return Refuse(http::status::payload_too_large, "requests to this server have no body");
    }
    const bool is_malformed = error.category() == http::make_error_code(http::error::bad_value).category() &&
                              error != http::error::end_of_stream && error != http::error::partial_message;
    if (is_malformed) return Refuse(http::status::bad_request, "this is no HTTP request");
    Remove();  // gone, or too slow
  }

  void Answer() {
    request_ = parser_->release();
    if (request_.version() > 11) {
      return Refuse(http::status::http_version_not_supported, "this server speaks HTTP/1.1");
    }
    if (request_.count(http::field::host) > 1 || request_.count(http::field::origin) > 1) {
      return Refuse(http::status::bad_request, "a field is there twice");
    }
    WebRequest asked = RequestOf(request_);
    asked.user = user_;
    if (const auto refusal = registry_.rules().Check(asked)) return Refuse(*refusal);
    if (beast::websocket::is_upgrade(request_)) return ForAdmitted(&HttpConnection::Upgrade);
    if (request_.method() != http::verb::get && request_.method() != http::verb::head) {
      return Refuse(http::status::method_not_allowed, "this server only answers GET and HEAD");
    }
    if (PathOf(View(request_.target())) == kAccessPath) return ForAdmitted(&HttpConnection::TellAccess);
    const WebResource* const resource = registry_.FindResource(PathOf(View(request_.target())));
    if (resource == nullptr) return Refuse(http::status::not_found, "there is no such page");
    Send(http::status::ok, resource->content_type, resource->content, request_.keep_alive());
  }

  void TellAccess(WebRole role) {
    text_ = WebRoleName(role);
    Send(http::status::ok, "text/plain; charset=utf-8", text_, request_.keep_alive());
  }

  // Hands what is asked for to `serve`, if its sender may have it.
  void ForAdmitted(void (HttpConnection::*serve)(WebRole role)) {
    const auto access = registry_.rules().Admit(RequestOf(request_));
    if (const auto* const refusal = std::get_if<AccessRules::Refusal>(&access)) return Refuse(*refusal);
    (this->*serve)(std::get<WebRole>(access));
  }

  void Upgrade(WebRole role) {
    const auto offered = View(request_[http::field::sec_websocket_protocol]);
    for (const auto& each : http::token_list(request_[http::field::sec_websocket_protocol])) {
      const WebProtocol* const protocol = registry_.FindProtocol(View(each));
      if (protocol == nullptr) continue;
      if (!registry_.MakeRoomFor(role, View(each) == protocol->kept_name)) {
        return Refuse(http::status::service_unavailable, "there are " + std::to_string(registry_.limits().clients) +
                                                             " clients already; close one of them");
      }
      std::string name(View(each));
      const auto self = shared_from_this();
      registry_.Remove(visitor_ != nullptr ? visitor_ : self);
      return ServeWebSocket(registry_, stream_.release_socket(), std::move(request_), *protocol, std::move(name), role);
    }
    Refuse(http::status::bad_request, (offered.empty() ? "no protocol is asked for (Sec-WebSocket-Protocol)"
                                                       : "none of the protocols that are asked for is known here") +
                                          ("; there is " + registry_.ProtocolNames()));
  }

  void Refuse(const AccessRules::Refusal& refusal) { Refuse(static_cast<http::status>(refusal.status), refusal.text); }
  void Refuse(http::status status, std::string text) {
    text_ = std::move(text) + "\n";
    Send(status, "text/plain; charset=utf-8", text_, false);
  }

  // `body` stays until it has been sent.
  void Send(http::status status, std::string_view type, std::string_view body, bool keep_alive) {
    const bool is_head = request_.method() == http::verb::head;
    response_ = {};
    response_.version(11);
    response_.result(status);
    response_.keep_alive(keep_alive);
    response_.set(http::field::content_type, beast::string_view(type.data(), type.size()));
    response_.set(http::field::cache_control, "no-store");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("X-Frame-Options", "DENY");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.set("Cross-Origin-Opener-Policy", "same-origin");
    if (status == http::status::ok) {
      response_.set("Content-Security-Policy", ContentPolicy(request_));
    }
    if (status == http::status::method_not_allowed) response_.set(http::field::allow, "GET, HEAD");
    if (status == http::status::unauthorized) {
      response_.set(http::field::www_authenticate, "Bearer realm=\"runnel\"");
    }
    response_.content_length(body.size());
    if (!is_head) response_.body() = {body.data(), body.size()};
    serializer_.emplace(response_);
    SendPiece();
  }

  // So that a slow line is enough for a large answer: who takes some of it is there. With TLS it is not seen here what is taken: the
  // visitor sees to it.
  void SendPiece() {
    stream_.expires_never();
    if (visitor_ == nullptr) stream_.expires_after(registry_.limits().request_time);
    http::async_write_some(stream_, *serializer_, Handler(*this, &HttpConnection::OnSent));
  }

  void OnSent(beast::error_code error, std::size_t /*bytes*/) {
    if (error) return Remove();
    if (serializer_->is_done() && response_.keep_alive()) return Read();
    if (!serializer_->is_done()) return SendPiece();
    stream_.socket().shutdown(tcp::socket::shutdown_send, error);
    stream_.expires_after(kTimeToDrain);
    Drain({}, 0);
  }

  // Closing while something is still to be read would take the answer from the client.
  void Drain(beast::error_code error, std::size_t bytes) {
    drained_ += bytes;
    if (error || drained_ > kMostToDrain) return Remove();
    stream_.async_read_some(boost::asio::buffer(drain_), Handler(*this, &HttpConnection::Drain));
  }

  ConnectionRegistry& registry_;
  const std::optional<std::uint32_t> user_;
  const std::shared_ptr<WebConnection> visitor_;  // nullptr: this one
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  HttpRequest request_;
  http::response<http::span_body<const char>> response_;
  std::optional<http::response_serializer<http::span_body<const char>>> serializer_;  // of response_
  std::string text_;  // that is sent, if it is none of the resources
  std::array<char, 4096> drain_{};
  std::size_t drained_ = 0;
};

}  // namespace

void ServeHttp(ConnectionRegistry& registry, tcp::socket socket, std::optional<std::uint32_t> user,
               std::shared_ptr<WebConnection> visitor) {
  const bool is_visitor = visitor == nullptr;
  const auto connection = std::make_shared<HttpConnection>(registry, std::move(socket), user, std::move(visitor));
  if (is_visitor) registry.AddVisitor(connection);
  OrRemove(*connection, [&] { connection->Read(); });
}

}  // namespace runnel::internal
