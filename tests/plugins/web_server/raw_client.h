#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace runnel::test {

/// The other end of a web server, by which a test can send whatever it likes. Waits for 20 s at most.
class RawClient {
 public:
  explicit RawClient(std::uint16_t port);
  ~RawClient();
  RawClient(RawClient&& other) noexcept;
  RawClient& operator=(RawClient&&) = delete;

  /// False if the server has closed the connection.
  bool Send(std::string_view bytes) const;
  /// Sends no more; the server can still answer.
  void CloseSending() const;
  /// What comes until the server closes the connection, or `until` has come.
  std::string Read(std::string_view until = {});
  /// Whether the server closes the connection; what comes before is forgotten.
  bool IsClosed();

  /// A request of HTTP; `headers` are whole lines. Returns head and body of the answer.
  std::string Get(const std::string& target, const std::string& headers = {});

  /// Asks for a WebSocket, and returns the head of the answer.
  std::string Upgrade(const std::string& protocol, const std::string& headers = {}, const std::string& target = "/");
  /// One frame, masked as clients have to.
  static std::string Frame(int operation, std::string_view payload, bool is_last = true);
  bool SendText(std::string_view text) const { return Send(Frame(1, text)); }
  struct Message {
    int operation;  ///< 1 text, 2 binary, 8 closing, 9 ping, 10 pong
    std::string payload;
    /// Of a closing frame.
    [[nodiscard]] int code() const;
    [[nodiscard]] std::string reason() const;
  };
  /// Waits for a ping and answers it. False: something else has come, or the connection is closed.
  bool AnswerPing();
  /// The next frame, but for pings, which are answered. Nothing: the connection is closed.
  std::optional<Message> Receive();
  /// Until one of this operation comes.
  std::optional<Message> Receive(int operation);

  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  [[nodiscard]] std::string host() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  bool Fill();
  std::optional<Message> ReceiveAny();

  std::uint16_t port_;
  int descriptor_;
  std::string bytes_;
  Message begun_{};  // whose last frame has not come yet
};

}  // namespace runnel::test
