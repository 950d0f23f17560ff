#include <algorithm>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>

#include "core/base/characters.h"
#include "core/base/error.h"
#include "plugins/web_server/internal/beast_connections.h"
#include "plugins/web_server/internal/token_bucket.h"

namespace runnel::internal {

namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::asio::ip::tcp;
using SteadyTime = WebSession::SteadyTime;

// However soon a session wants its next turn, others have theirs before.
constexpr auto kShortestPause = std::chrono::milliseconds(1);
// For a client to answer that it ends.
constexpr auto kTimeToSayGoodbye = std::chrono::milliseconds(1000);
// Of what has come too soon so much may wait as is handed over in this time; of what may be late, in the other one.
constexpr double kSecondsOfWaiting = 1, kSecondsOfWaitingLate = 5;
// Of a larger message so much is sent at once. The rest comes behind pings, and a slow line has as much time for each piece.
constexpr std::size_t kPiece = 64 * 1024;
// What is longer does not fit into a closing frame.
constexpr std::size_t kLongestReason = 120;

SteadyTime Now() { return std::chrono::steady_clock::now(); }

/// By which other threads reach a connection for as long as it is there.
class WakeHandle : public std::enable_shared_from_this<WakeHandle> {
 public:
  WakeHandle(boost::asio::io_context& context, std::weak_ptr<WebConnection> connection)
      : context_(&context), connection_(std::move(connection)) {}

  void Wake() noexcept {
    const std::lock_guard lock(mutex_);
    if (context_ == nullptr || is_woken_) return;
    try {
      boost::asio::post(*context_, [handle = shared_from_this()] { handle->Turn(); });
      is_woken_ = true;
    } catch (...) {  // for want of memory: its session has the next turn that it has asked for itself
    }
  }
  /// The connection goes, and the server may go after it.
  void Forget() {
    const std::lock_guard lock(mutex_);
    context_ = nullptr;
  }

 private:
  void Turn() {
    {
      const std::lock_guard lock(mutex_);
      is_woken_ = false;
    }
    if (const auto alive = connection_.lock()) OrRemove(*alive, [&] { alive->Poll(); });
  }

  std::mutex mutex_;
  boost::asio::io_context* context_;  // guarded by mutex_; nullptr when the connection has gone
  const std::weak_ptr<WebConnection> connection_;
  bool is_woken_ = false;  // guarded by mutex_: a turn has been asked for and has not come yet
};

/// One WebSocket with its session.
class WebSocketConnection final : public WebConnection,
                                  public WebClient,
                                  public std::enable_shared_from_this<WebSocketConnection> {
 public:
  WebSocketConnection(ConnectionRegistry& registry, tcp::socket socket, HttpRequest request,
                      const WebProtocol& protocol, std::string name, WebRole role)
      : WebConnection(role, name == protocol.kept_name),
        registry_(registry),
        request_(std::move(request)),
        start_(protocol.start),
        name_(std::move(name)),
        socket_(std::move(socket)),
        poll_timer_(registry.context()),
        read_timer_(registry.context()),
        write_timer_(registry.context()),
        bucket_(registry.limits().messages_per_second, Now()) {}

  void Accept() {
    const WebLimits& limits = registry_.limits();
    socket_.set_option(websocket::stream_base::timeout{limits.request_time, limits.idle_time, true});
    socket_.set_option(websocket::stream_base::decorator([this](websocket::response_type& response) {
      response.set(beast::http::field::sec_websocket_protocol, name_);
    }));
    socket_.read_message_max(limits.message_bytes);
    socket_.auto_fragment(false);
    socket_.control_callback([this](websocket::frame_type kind, beast::string_view text) {
      if (kind == websocket::frame_type::close) return BeginClosing();  // answered by Beast
      bucket_.Consume(text.size(), Now());
      if (bucket_.IsFlood()) Close("too many pings");
    });
    socket_.async_accept(request_, Handler(*this, &WebSocketConnection::OnAccepted));
  }

  bool SendText(std::string text) override { return Send({std::move(text), true}); }
  bool SendBinary(std::string bytes) override { return Send({std::move(bytes), false}); }
  [[nodiscard]] std::size_t waiting_bytes() const override { return waiting_bytes_; }
  [[nodiscard]] const std::string& protocol() const override { return name_; }
  [[nodiscard]] WebRole role() const override { return WebConnection::role(); }
  [[nodiscard]] std::optional<WebArrival> arrival() const override { return arrival_; }
  void Close(std::string reason) override { Close(websocket::close_code::policy_error, reason); }

  void Poll() override {
    if (session_ == nullptr || is_closing_) return;
    Attempt([this] {
      const SteadyTime next = session_->OnPoll();
      if (is_closing_) return;
      At(std::max(next, Now() + kShortestPause), poll_timer_, &WebSocketConnection::Poll);
    });
  }
  void End(std::string_view reason) override { Close(websocket::close_code::going_away, reason); }
  [[nodiscard]] std::function<void()> Waker() override {
    if (!wake_handle_) {
      wake_handle_ = std::make_shared<WakeHandle>(registry_.context(), weak_from_this());
    }
    return [handle = wake_handle_] { handle->Wake(); };
  }
  void Cut() noexcept override {
    beast::error_code ignored;
    socket_.next_layer().close(ignored);
  }
  void Remove() override {
    if (std::exchange(is_removed_, true)) return;
    poll_timer_.cancel();
    read_timer_.cancel();
    write_timer_.cancel();
    Cut();
    if (wake_handle_) wake_handle_->Forget();
    session_.reset();
    registry_.Remove(shared_from_this());
  }

 private:
  struct Message {
    std::string bytes;
    bool is_text;
    WebArrival arrival = {};
  };

  // Unless the timer is cancelled or set anew by then.
  void At(SteadyTime time, boost::asio::steady_timer& timer, void (WebSocketConnection::*act)()) {
    timer.expires_at(time);
    timer.async_wait(Handler(*this, [act](WebSocketConnection& self, beast::error_code cancelled) {
      if (!cancelled) (self.*act)();
    }));
  }

  template <typename Do>
  void Attempt(const Do& attempt) {
    try {
      attempt();
    } catch (...) {
      Close(websocket::close_code::internal_error, DescribeException());
    }
  }

  void OnAccepted(beast::error_code error) {
    request_ = {};
    if (error || is_closing_) return Remove();
    is_accepted_ = true;
    Attempt([this] { session_ = start_(*this); });
    Poll();
    Read();
  }

  void Read() { socket_.async_read(buffer_, Handler(*this, &WebSocketConnection::OnRead)); }

  void OnRead(beast::error_code error, std::size_t /*bytes*/) {
    // What was read before may be handed over after a failed write has removed this.
    if (error || is_removed_) return Remove();
    if (is_closing_) {  // only the client's end of it is of interest
      buffer_.clear();
      return Read();
    }
    Message message{beast::buffers_to_string(buffer_.data()), socket_.got_text()};
    buffer_.clear();
    buffer_.shrink_to_fit();
    Attempt([&] { message.arrival = session_->OnArrival(message.bytes, message.is_text); });
    if (message.arrival.outranks) {
      HandOver(message);
    } else if (!is_closing_ && HasRoomFor(message)) {
      early_cost_ += TokenBucket::CostOf(message.bytes.size());
      early_.push_back(std::move(message));
    } else if (!is_closing_) {
      Attempt([&] { session_->OnTooMany(message.bytes, message.is_text); });
    }
    HandOverEarly();
    Read();  // always: what outranks may be behind what is refused
  }

  void HandOver(const Message& message) {
    if (is_closing_) return;
    arrival_ = message.arrival;
    Attempt([&] {
      if (message.is_text) {
        session_->OnText(message.bytes);
      } else {
        session_->OnBinary(message.bytes);
      }
    });
    arrival_.reset();
    Poll();
  }

  // What has come too soon waits.
  void HandOverEarly() {
    if (is_removed_) return;
    while (!early_.empty() && Now() >= next_at_) {
      const Message message = std::move(early_.front());
      early_.pop_front();
      early_cost_ -= TokenBucket::CostOf(message.bytes.size());
      bucket_.Consume(message.bytes.size(), Now());
      next_at_ = Now() + bucket_.Wait();
      HandOver(message);
    }
    if (early_.empty()) return;
    At(next_at_, read_timer_, &WebSocketConnection::HandOverEarly);
  }

  [[nodiscard]] bool HasRoomFor(const Message& message) const {
    const double seconds = message.arrival.may_be_late ? kSecondsOfWaitingLate : kSecondsOfWaiting;
    const double most = seconds * registry_.limits().messages_per_second;
    return early_.empty() || early_cost_ + TokenBucket::CostOf(message.bytes.size()) <= most;
  }

  bool Send(Message message) {
    if (is_closing_) return false;
    if (waiting_bytes_ > 0 && waiting_bytes_ + message.bytes.size() > registry_.limits().waiting_bytes) {
      return false;
    }
    const std::size_t size = message.bytes.size();
    waiting_.push_back(std::move(message));
    waiting_bytes_ += size;
    if (waiting_.size() == 1) Write();
    return true;
  }

  void Write() {
    const Message& message = waiting_.front();
    const auto piece = boost::asio::buffer(boost::asio::buffer(message.bytes) + written_, kPiece);
    socket_.text(message.is_text);
    // A client that takes nothing of it all that time is not there any more.
    At(Now() + registry_.limits().idle_time, write_timer_, &WebSocketConnection::Cut);
    socket_.async_write_some(written_ + piece.size() == message.bytes.size(), piece,
                             Handler(*this, [size = piece.size()](WebSocketConnection& self, beast::error_code error,
                                                                  std::size_t) { self.OnWritten(error, size); }));
  }

  void OnWritten(beast::error_code error, std::size_t size) {
    written_ += size;
    write_timer_.cancel();
    if (!error && !is_closing_ && written_ < waiting_.front().bytes.size()) return Write();
    written_ = 0;
    waiting_bytes_ -= waiting_.front().bytes.size();
    waiting_.pop_front();
    if (error) return Remove();
    if (is_closing_) {
      waiting_.clear();
      waiting_bytes_ = 0;
    } else if (!waiting_.empty()) {
      Write();
    }
  }

  void Close(websocket::close_code code, std::string_view reason) {
    if (is_closing_ || is_removed_) return;
    BeginClosing();
    if (!is_accepted_) return Cut();  // there is nobody yet who could be told
    websocket::close_reason why(code);
    const std::string cut(reason.substr(0, WholeCharacters(reason, kLongestReason)));
    why.reason.assign(cut.data(), cut.size());
    socket_.async_close(why, Handler(*this, [](WebSocketConnection& self, beast::error_code) { self.Remove(); }));
  }

  // Whoever does not close its end soon is cut.
  void BeginClosing() {
    is_closing_ = true;
    // Not here: it may be the session itself that has asked for it.
    boost::asio::post(registry_.context(), Handler(*this, [](WebSocketConnection& self) { self.session_.reset(); }));
    At(Now() + kTimeToSayGoodbye, poll_timer_, &WebSocketConnection::Cut);
  }

  ConnectionRegistry& registry_;
  HttpRequest request_;
  const std::function<std::unique_ptr<WebSession>(WebClient&)> start_;
  const std::string name_;
  // Over a plain socket: a stream of WebSockets minds the time itself. false: nothing is compressed.
  websocket::stream<tcp::socket, false> socket_;
  boost::asio::steady_timer poll_timer_;
  boost::asio::steady_timer read_timer_;
  boost::asio::steady_timer write_timer_;
  beast::flat_buffer buffer_;
  TokenBucket bucket_;
  SteadyTime next_at_{};               // the next message may be handed over
  std::deque<Message> early_;          // that have been read and not handed over yet
  double early_cost_ = 0;              // of those
  std::optional<WebArrival> arrival_;  // of the message that is being handed over
  std::deque<Message> waiting_;
  std::size_t written_ = 0;  // of the first
  std::size_t waiting_bytes_ = 0;
  bool is_accepted_ = false;
  bool is_closing_ = false;
  bool is_removed_ = false;
  std::shared_ptr<WakeHandle> wake_handle_;  // nullptr until somebody has asked for it
  std::unique_ptr<WebSession> session_;      // first to go: it uses the rest
};

}  // namespace

void ServeWebSocket(ConnectionRegistry& registry, tcp::socket socket, HttpRequest request, const WebProtocol& protocol,
                    std::string name, WebRole role) {
  const auto connection = std::make_shared<WebSocketConnection>(registry, std::move(socket), std::move(request),
                                                                protocol, std::move(name), role);
  registry.Add(connection);
  OrRemove(*connection, [&] { connection->Accept(); });
}

}  // namespace runnel::internal
