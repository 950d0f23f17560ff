#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace runnel::test {

/// The other end of a server that encrypts. Waits for 20 s at most.
class TlsClient {
 public:
  /// Trusts the one certificate in the file, and no other.
  TlsClient(std::uint16_t port, const std::string& certificate, int newest_version = 0);
  ~TlsClient();
  TlsClient(const TlsClient&) = delete;
  TlsClient& operator=(const TlsClient&) = delete;

  /// Whether keys have been agreed on.
  [[nodiscard]] bool is_open() const noexcept { return is_open_; }
  bool Send(std::string_view bytes);
  /// Until this has come, or the server has closed the connection.
  std::string Read(std::string_view until = {});
  /// At most so many bytes of what comes next; "": the server has closed the connection.
  std::string ReadPiece(std::size_t most);

 private:
  struct State;
  const std::unique_ptr<State> state_;
  bool is_open_ = false;
};

}  // namespace runnel::test
