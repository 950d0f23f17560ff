#include "tests/plugins/web_server/raw_client.h"

#include <cerrno>
#include <utility>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace runnel::test {

namespace {

constexpr int kTimeout = 20'000;  // ms

bool Await(int descriptor, short events) {
  pollfd polled{descriptor, events, 0};
  return poll(&polled, 1, kTimeout) > 0;
}

}  // namespace

RawClient::RawClient(std::uint16_t port) : port_(port), descriptor_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const auto* const generic = reinterpret_cast<const sockaddr*>(&address);
  EXPECT_EQ(connect(descriptor_, generic, sizeof address), 0);
}

RawClient::RawClient(RawClient&& other) noexcept
    : port_(other.port_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      bytes_(std::move(other.bytes_)),
      begun_(std::move(other.begun_)) {}

RawClient::~RawClient() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool RawClient::Send(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t count = send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if ((errno != EAGAIN && errno != EINTR) || !Await(descriptor_, POLLOUT)) {
      return false;
    }
  }
  return true;
}

void RawClient::CloseSending() const { shutdown(descriptor_, SHUT_WR); }

bool RawClient::Fill() {
  char more[65'536];
  if (!Await(descriptor_, POLLIN)) {
    ADD_FAILURE() << "nothing has come for too long; so far: " << bytes_.substr(0, 1000);
    return false;
  }
  const ssize_t count = recv(descriptor_, more, sizeof more, 0);
  if (count <= 0) return false;
  bytes_.append(more, static_cast<std::size_t>(count));
  return true;
}

std::string RawClient::Read(std::string_view until) {
  for (;;) {
    const std::size_t found = until.empty() ? std::string::npos : bytes_.find(until);
    if (found != std::string::npos) {
      std::string read = bytes_.substr(0, found + until.size());
      bytes_.erase(0, found + until.size());
      return read;
    }
    if (!Fill()) return std::exchange(bytes_, {});
  }
}

bool RawClient::IsClosed() {
  char ignored[65'536];
  for (;;) {
    if (!Await(descriptor_, POLLIN)) return false;
    if (recv(descriptor_, ignored, sizeof ignored, 0) <= 0) return true;
  }
}

std::string RawClient::Get(const std::string& target, const std::string& headers) {
  Send("GET " + target + " HTTP/1.1\r\nHost: " + host() + "\r\n" + headers + "\r\n");
  std::string answer = Read("\r\n\r\n");
  const std::size_t length = answer.find("Content-Length: ");
  if (length == std::string::npos) return answer;
  const std::size_t size = std::stoul(answer.substr(length + 16));
  while (bytes_.size() < size && Fill()) {
  }
  answer += bytes_.substr(0, size);
  bytes_.erase(0, size);
  return answer;
}

std::string RawClient::Upgrade(const std::string& protocol, const std::string& headers, const std::string& target) {
  Send("GET " + target + " HTTP/1.1\r\nHost: " + host() +
       "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
       "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
       (protocol.empty() ? "" : "Sec-WebSocket-Protocol: " + protocol + "\r\n") + headers + "\r\n");
  return Read("\r\n\r\n");
}

std::string RawClient::Frame(int operation, std::string_view payload, bool is_last) {
  std::string frame(1, static_cast<char>((is_last ? 0x80 : 0) | operation));
  const std::size_t size = payload.size();
  int bytes_of_size = 0;
  if (size < 126) {
    frame += static_cast<char>(0x80U | size);
  } else if (size < 65'536) {
    frame += static_cast<char>(0x80 | 126);
    bytes_of_size = 2;
  } else {
    frame += static_cast<char>(0x80 | 127);
    bytes_of_size = 8;
  }
  for (int i = bytes_of_size - 1; i >= 0; --i) frame += static_cast<char>(size >> (8 * i));
  frame += std::string("\x01\x02\x03\x04", 4);
  for (std::size_t i = 0; i < size; ++i) frame += static_cast<char>(payload[i] ^ (i % 4 + 1));
  return frame;
}

std::optional<RawClient::Message> RawClient::ReceiveAny() {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes_[i]); };
  const auto have = [&](std::size_t count) {
    while (bytes_.size() < count) {
      if (!Fill()) return false;
    }
    return true;
  };
  for (;;) {
    if (!have(2)) return {};
    std::size_t size = byte(1) & 0x7fU;
    std::size_t head = 2;
    if (size >= 126) {
      head = size == 126 ? 4 : 10;
      if (!have(head)) return {};
      size = 0;
      for (std::size_t i = 2; i < head; ++i) size = size * 256 + byte(i);
    }
    if (!have(head + size)) return {};
    const bool is_last = (byte(0) & 0x80U) != 0;
    Message frame{byte(0) & 0x0f, bytes_.substr(head, size)};
    bytes_.erase(0, head + size);
    if (frame.operation >= 8) return frame;  // it may come between two frames of a message
    if (frame.operation != 0) begun_.operation = frame.operation;
    begun_.payload += frame.payload;
    if (is_last) return std::exchange(begun_, {});
  }
}

bool RawClient::AnswerPing() {
  const auto message = ReceiveAny();
  return message && message->operation == 9 && Send(Frame(10, message->payload));
}

std::optional<RawClient::Message> RawClient::Receive() {
  for (;;) {
    auto message = ReceiveAny();
    if (!message || message->operation != 9) return message;
    Send(Frame(10, message->payload));
  }
}

std::optional<RawClient::Message> RawClient::Receive(int operation) {
  for (;;) {
    auto message = Receive();
    if (!message || message->operation == operation) return message;
  }
}

int RawClient::Message::code() const {
  if (payload.size() < 2) return 0;
  return static_cast<unsigned char>(payload[0]) * 256 + static_cast<unsigned char>(payload[1]);
}
std::string RawClient::Message::reason() const { return payload.size() < 2 ? "" : payload.substr(2); }

}  // namespace runnel::test
