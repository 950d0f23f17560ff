#include "plugins/wire_shared_memory/segment_server.h"

#include <cerrno>
#include <cstring>
#include <new>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

namespace runnel {

namespace {

constexpr int kWaiting = 64;
constexpr auto kAgain = std::chrono::milliseconds(10);

sockaddr_un AddressOf(const SegmentId& server, socklen_t& size) {
  std::string name = "runnel-segments-";
  for (const std::byte each : server) name += fmt::format("{:02x}", std::to_integer<unsigned>(each));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path + 1, name.data(), name.size());  // behind a zero: in no folder
  size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return address;
}

bool IsOfThisUser(int socket) {
  ucred who{};
  socklen_t size = sizeof who;
  return getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &who, &size) == 0 && who.uid == geteuid();
}

void LimitWaiting(int socket) {
  const timeval most{.tv_sec = 0, .tv_usec = 500'000};
  (void)setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most);
  (void)setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &most, sizeof most);
}

// Two files go along with one octet: the segment and the table.
struct Passing {
  static constexpr std::size_t kFiles = 2 * sizeof(int);
  char octet = 0;
  iovec part{&octet, 1};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(kFiles)> control{};
  msghdr message{};
  Passing() {
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
  }
};

// All that have come with it, and are to be closed, however many another program has sent.
std::vector<FileDescriptor> FilesIn(const msghdr& message) {
  std::vector<FileDescriptor> files;
  const cmsghdr* const head = CMSG_FIRSTHDR(&message);
  if (head == nullptr || head->cmsg_level != SOL_SOCKET || head->cmsg_type != SCM_RIGHTS) return files;
  const unsigned char* at = CMSG_DATA(head);
  for (std::size_t left = head->cmsg_len - CMSG_LEN(0); left >= sizeof(int); left -= sizeof(int), at += sizeof(int)) {
    int file = 0;
    std::memcpy(&file, at, sizeof file);
    files.emplace_back(file);
  }
  return files;
}

}  // namespace

Result<std::unique_ptr<SegmentServer>> SegmentServer::Start() {
  const SegmentId id = NewSegmentId();
  FileDescriptor socket(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  socklen_t size = 0;
  const sockaddr_un address = AddressOf(id, size);
  if (!socket.is_open() || bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
      listen(socket.number(), kWaiting) != 0) {
    return SystemError("shared memory cannot be handed out");
  }
  return std::unique_ptr<SegmentServer>(new SegmentServer(std::move(socket), id));
}

SegmentServer::SegmentServer(FileDescriptor socket, const SegmentId& id)
    : socket_(std::move(socket)), id_(id), thread_([this] { Run(); }) {}

SegmentServer::~SegmentServer() {
  (void)shutdown(socket_.number(), SHUT_RDWR);  // ends accept()
  thread_.join();
}

void SegmentServer::Offer(const WrittenSegment& segment) {
  const std::lock_guard lock(mutex_);
  segments_[segment.id()] = {segment.descriptor(), segment.holders()};
}

void SegmentServer::Withdraw(const WrittenSegment& segment) {
  const std::lock_guard lock(mutex_);
  segments_.erase(segment.id());
}

void SegmentServer::Run() noexcept {
  for (bool goes_on = true; goes_on;) {
    try {
      goes_on = Serve();
    } catch (const std::bad_alloc&) {  // who has asked finds the link closed
      std::this_thread::sleep_for(kAgain);
    }
  }
}

bool SegmentServer::Serve() {
  std::vector<pollfd> seen = {{socket_.number(), POLLIN, 0}};
  for (const Reader& each : readers_) seen.push_back({each.link.number(), POLLIN, 0});
  if (poll(seen.data(), seen.size(), -1) < 0 && errno != EINTR) {
    std::this_thread::sleep_for(kAgain);  // out of memory, for now
    return true;
  }
  LookAtReaders(seen);
  if (seen[0].revents == 0) return true;
  FileDescriptor asking(accept4(socket_.number(), nullptr, nullptr, SOCK_CLOEXEC));
  if (asking.is_open()) {
    Answer(std::move(asking));
  } else if (errno == EINVAL || errno == EBADF) {
    return false;  // shut down
  } else if (errno != EINTR && errno != ECONNABORTED) {
    std::this_thread::sleep_for(kAgain);  // out of descriptors, for now
  }
  return true;
}

void SegmentServer::LookAtReaders(const std::vector<pollfd>& seen) {
  std::size_t place = 0;
  std::erase_if(readers_, [&](const Reader& each) {
    if (seen[++place].revents == 0) return false;  // nobody says anything more
    each.holders->Remove(*each.table);
    return true;
  });
}

void SegmentServer::Answer(FileDescriptor asking) {
  if (!IsOfThisUser(asking.number())) return;
  LimitWaiting(asking.number());
  SegmentId wanted{};
  if (recv(asking.number(), wanted.data(), wanted.size(), 0) != static_cast<ssize_t>(wanted.size())) return;
  auto table = HoldTable::Make();
  if (!table) return;
  const std::lock_guard lock(mutex_);  // as long as the file must be open
  const auto found = segments_.find(wanted);
  if (found == segments_.end()) return;
  const std::array<int, 2> files = {found->second.descriptor, (*table)->descriptor()};
  Passing passing;
  cmsghdr* const head = CMSG_FIRSTHDR(&passing.message);
  head->cmsg_level = SOL_SOCKET;
  head->cmsg_type = SCM_RIGHTS;
  head->cmsg_len = CMSG_LEN(Passing::kFiles);
  std::memcpy(CMSG_DATA(head), files.data(), Passing::kFiles);
  readers_.reserve(readers_.size() + 1);
  // It counts before the reader has it.
  found->second.holders->Add(*table);
  readers_.push_back({std::move(asking), found->second.holders, *table});
  // If it cannot be sent, the link is closed at the other end.
  (void)sendmsg(readers_.back().link.number(), &passing.message, MSG_NOSIGNAL);
}

Result<std::shared_ptr<ReadSegment>> FetchSegment(const SegmentPlace& place) {
  const Error gone{.message = "the memory that a value lies in has gone with its writer, or belongs to another user"};
  FileDescriptor socket(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  if (!socket.is_open()) return SystemError("shared memory cannot be asked for");
  LimitWaiting(socket.number());
  socklen_t size = 0;
  const sockaddr_un address = AddressOf(place.server, size);
  if (connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), size) != 0) return gone;
  if (!IsOfThisUser(socket.number())) return gone;
  if (send(socket.number(), place.segment.data(), place.segment.size(), MSG_NOSIGNAL) < 0) return gone;
  Passing passing;
  if (recvmsg(socket.number(), &passing.message, MSG_CMSG_CLOEXEC) <= 0) return gone;
  std::vector<FileDescriptor> files = FilesIn(passing.message);
  if (files.size() != 2) return gone;
  auto holds = HoldTable::Map(std::move(files[1]));
  if (!holds) return holds.error();
  return ReadSegment::Map(files[0], std::move(*holds), std::move(socket));
}

}  // namespace runnel
