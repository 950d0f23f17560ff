#include "tests/plugins/web_server/tls_client.h"

#include <algorithm>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <openssl/ssl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace runnel::test {

struct TlsClient::State {
  SSL_CTX* context = SSL_CTX_new(TLS_client_method());
  SSL* connection = nullptr;
  int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
};

TlsClient::TlsClient(std::uint16_t port, const std::string& certificate, int newest_version)
    : state_(std::make_unique<State>()) {
  SSL_CTX_load_verify_locations(state_->context, certificate.c_str(), nullptr);
  SSL_CTX_set_verify(state_->context, SSL_VERIFY_PEER, nullptr);
  // What is old must be asked for, and OpenSSL itself must allow it, for the server to be what refuses it.
  SSL_CTX_set_security_level(state_->context, 0);
  SSL_CTX_set_max_proto_version(state_->context, newest_version);
  if (newest_version != 0) SSL_CTX_set_min_proto_version(state_->context, newest_version);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const timeval patience{.tv_sec = 20, .tv_usec = 0};
  setsockopt(state_->descriptor, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  setsockopt(state_->descriptor, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  if (connect(state_->descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return;
  }
  state_->connection = SSL_new(state_->context);
  SSL_set_fd(state_->connection, state_->descriptor);
  SSL_set1_host(state_->connection, "localhost");
  is_open_ = SSL_connect(state_->connection) == 1;
}

TlsClient::~TlsClient() {
  SSL_free(state_->connection);
  SSL_CTX_free(state_->context);
  close(state_->descriptor);
}

bool TlsClient::Send(std::string_view bytes) {
  return is_open_ &&
         SSL_write(state_->connection, bytes.data(), static_cast<int>(bytes.size())) == static_cast<int>(bytes.size());
}

std::string TlsClient::Read(std::string_view until) {
  std::string read;
  while (is_open_ && (until.empty() || read.find(until) == std::string::npos)) {
    char more[16'384];
    const int count = SSL_read(state_->connection, more, sizeof more);
    if (count <= 0) break;
    read.append(more, static_cast<std::size_t>(count));
  }
  return read;
}

std::string TlsClient::ReadPiece(std::size_t most) {
  std::string piece(most, ' ');
  const int count = is_open_ ? SSL_read(state_->connection, piece.data(), static_cast<int>(most)) : 0;
  piece.resize(static_cast<std::size_t>(std::max(count, 0)));
  return piece;
}

}  // namespace runnel::test
