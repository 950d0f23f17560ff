#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <sys/socket.h>
#include <unistd.h>

#include "plugins/web_server/internal/beast_connections.h"

namespace runnel::internal {

namespace asio = boost::asio;
namespace ssl = asio::ssl;
using asio::ip::tcp;
using boost::system::error_code;

class TlsIdentity {
 public:
  TlsIdentity() {
    SSL_CTX* const native = context.native_handle();
    SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
    // A client that asks for new keys again and again has the server compute for nothing.
    SSL_CTX_set_options(native, SSL_OP_NO_RENEGOTIATION | SSL_OP_CIPHER_SERVER_PREFERENCE);
    SSL_CTX_set_mode(native, SSL_MODE_RELEASE_BUFFERS);
    SSL_CTX_set_session_cache_mode(native, SSL_SESS_CACHE_OFF);
    // Nobody is there to be asked for the password of a key.
    SSL_CTX_set_default_passwd_cb(native, [](char*, int, int, void*) { return 0; });
  }

  ssl::context context{ssl::context::tls_server};
};

namespace {

constexpr auto kTimeToClose = std::chrono::seconds(1);
constexpr char kHandshakeRecord = 0x16;
constexpr std::string_view kNotEncrypted =
    "HTTP/1.1 400 Bad Request\r\nContent-Type: text/plain\r\nConnection: close\r\n\r\n"
    "this server encrypts: begin the address with https:// (wss:// for WebSockets)\n";

Error ErrorOf(std::string message, const std::filesystem::path& file, std::string hint) {
  return {.message = std::move(message), .position = {file.string()}, .hint = std::move(hint)};
}

/// The server's end of a connection that is encrypted: what comes is decrypted and written to a socket within this
/// process, at whose other end HTTP is spoken, and what comes from there is encrypted. So nothing else has to know of
/// TLS, and it is compiled once. At most one piece for each way is in memory; who does not read stops the other.
class TlsRelay final : public WebConnection, public std::enable_shared_from_this<TlsRelay> {
 public:
  TlsRelay(ConnectionRegistry& registry, std::shared_ptr<TlsIdentity> identity, tcp::socket socket,
           std::optional<std::uint32_t> user)
      : WebConnection(std::nullopt),
        registry_(registry),
        identity_(std::move(identity)),
        user_(user),
        outer_(std::move(socket), identity_->context),
        inner_(registry.context()),
        timer_(registry.context()) {}

  void Begin() {
    CutAfter(registry_.limits().request_time);
    outer_.next_layer().async_wait(tcp::socket::wait_read, Handler(*this, &TlsRelay::Greet));
  }
  void Remove() override {
    Cut();
    registry_.Remove(shared_from_this());
  }

  void Cut() noexcept override {
    error_code ignored;
    timer_.cancel(ignored);
    outer_.next_layer().close(ignored);
    inner_.close(ignored);
  }

 private:
  void Greet(error_code failure) {
    if (failure) return Remove();
    char first = 0;
    const ssize_t count = recv(outer_.next_layer().native_handle(), &first, 1, MSG_PEEK | MSG_DONTWAIT);
    if (count == 1 && first != kHandshakeRecord) return Explain();
    outer_.async_handshake(ssl::stream_base::server, Handler(*this, &TlsRelay::Connect));
  }

  // For a person who has typed the address without https://.
  void Explain() {
    asio::async_write(outer_.next_layer(), asio::buffer(kNotEncrypted), Handler(*this, &TlsRelay::OnExplained));
  }
  void OnExplained(error_code ignored, std::size_t /*bytes*/) {
    outer_.next_layer().shutdown(tcp::socket::shutdown_send, ignored);
    CutAfter(kTimeToClose);
    DrainOuter({}, 0);
  }

  // Closing while something is still to be read would take the answer from the client.
  void DrainOuter(error_code error, std::size_t /*bytes*/) {
    if (error) return Remove();
    outer_.next_layer().async_read_some(asio::buffer(in_), Handler(*this, &TlsRelay::DrainOuter));
  }

  // The end that speaks HTTP ends this one by closing. This one counts for both as long as it has something to send, but
  // while there is a session, which counts itself.
  void Connect(error_code error) {
    timer_.cancel();
    int ends[2];
    if (error || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return Remove();
    inner_.assign(tcp::v4(), ends[0], error);
    tcp::socket served(registry_.context());
    if (!error) served.assign(tcp::v4(), ends[1], error);
    if (error) {
      if (!inner_.is_open()) close(ends[0]);
      if (!served.is_open()) close(ends[1]);
      return Remove();
    }
    inner_.async_wait(tcp::socket::wait_error, Handler(*this, [](TlsRelay& self, error_code) {
                        if (self.inner_.is_open()) self.registry_.AddVisitor(self.shared_from_this());
                      }));
    ServeHttp(registry_, std::move(served), user_, shared_from_this());
    Decrypt({}, 0);
    Encrypt({}, 0);
  }

  void Decrypt(error_code error, std::size_t /*bytes*/) {
    if (!error) outer_.async_read_some(asio::buffer(in_), Handler(*this, &TlsRelay::OnDecrypted));
  }
  void OnDecrypted(error_code error, std::size_t bytes) {
    error_code ignored;
    // The other end reads what has come, and closes.
    if (error) return void(inner_.shutdown(tcp::socket::shutdown_send, ignored));
    asio::async_write(inner_, asio::buffer(in_, bytes), Handler(*this, &TlsRelay::Decrypt));
  }

  void Encrypt(error_code error, std::size_t /*bytes*/) {
    timer_.cancel();
    if (error) return Remove();
    inner_.async_read_some(asio::buffer(out_), Handler(*this, &TlsRelay::OnAnswer));
  }
  void OnAnswer(error_code error, std::size_t bytes) {
    if (error) return Shutdown();
    // A client that takes nothing of it all that time is not there any more.
    CutAfter(registry_.limits().idle_time);
    asio::async_write(outer_, asio::buffer(out_, bytes), Handler(*this, &TlsRelay::Encrypt));
  }

  void Shutdown() {
    CutAfter(kTimeToClose);
    outer_.async_shutdown(Handler(*this, [](TlsRelay& self, error_code) { self.Remove(); }));
  }

  void CutAfter(Duration time) {
    timer_.expires_after(time);
    timer_.async_wait(Handler(*this, [](TlsRelay& self, error_code cancelled) {
      if (!cancelled) self.Cut();
    }));
  }

  ConnectionRegistry& registry_;
  const std::shared_ptr<TlsIdentity> identity_;
  const std::optional<std::uint32_t> user_;
  ssl::stream<tcp::socket> outer_;
  tcp::socket inner_;
  asio::steady_timer timer_;
  std::array<char, 16 * 1024> in_;  // a record of TLS at most
  std::array<char, 16 * 1024> out_;
};

constexpr const char* kHowToMake =
    "openssl req -x509 -newkey rsa:2048 -nodes -days 365 -subj /CN=robot -keyout key.pem -out certificate.pem "
    "makes one";

}  // namespace

Result<std::shared_ptr<TlsIdentity>> LoadTlsIdentity(const std::filesystem::path& certificate_file,
                                                     const std::filesystem::path& key_file) {
  const std::filesystem::path& key = key_file.empty() ? certificate_file : key_file;
  if (certificate_file.empty()) {
    return ErrorOf("this key has no certificate", key, "give its certificate, too");
  }
  if (access(certificate_file.c_str(), R_OK) != 0) {
    return ErrorOf(std::string("the certificate cannot be read: ") + std::strerror(errno), certificate_file,
                   kHowToMake);
  }
  if (auto secret = CheckSecretFile(key); !secret) return secret.error();
  auto identity = std::make_shared<TlsIdentity>();
  error_code error;
  identity->context.use_certificate_chain_file(certificate_file.string(), error);
  if (error) {
    return ErrorOf("there is no certificate (PEM) in it: " + error.message(), certificate_file, kHowToMake);
  }
  identity->context.use_private_key_file(key.string(), ssl::context::pem, error);
  if (!error) return identity;
  if (ERR_GET_REASON(static_cast<unsigned long>(error.value())) == X509_R_KEY_VALUES_MISMATCH) {
    return ErrorOf("this key is not that of the certificate " + certificate_file.string(), key,
                   "give both of one pair");
  }
  return ErrorOf("there is no key (PEM, without a password) in it: " + error.message(), key,
                 "a password is taken off by openssl pkey -in KEY -out KEY_WITHOUT");
}

void ServeTls(ConnectionRegistry& registry, const std::shared_ptr<TlsIdentity>& identity, tcp::socket socket,
              std::optional<std::uint32_t> user) {
  const auto relay = std::make_shared<TlsRelay>(registry, identity, std::move(socket), user);
  registry.AddVisitor(relay);
  OrRemove(*relay, [&] { relay->Begin(); });
}

}  // namespace runnel::internal
