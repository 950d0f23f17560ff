#include <cstring>

#include <linux/inet_diag.h>
#include <linux/netlink.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "core/base/file_descriptor.h"
#include "plugins/web_server/internal/beast_connections.h"

namespace runnel::internal {

namespace {

using Endpoint = boost::asio::ip::tcp::endpoint;

void CopyAddress(const boost::asio::ip::address& address, __be32 (&to)[4]) {
  const auto copy = [&](const auto& bytes) { std::memcpy(to, bytes.data(), bytes.size()); };
  address.is_v4() ? copy(address.to_v4().to_bytes()) : copy(address.to_v6().to_bytes());
}

struct Question {
  nlmsghdr head{};
  inet_diag_req_v2 request{};
};

// For the one socket whose own end is `peer`, and whose other end is `own`.
Question QuestionFor(const Endpoint& peer, const Endpoint& own) {
  Question question;
  question.head.nlmsg_len = sizeof question;
  question.head.nlmsg_type = SOCK_DIAG_BY_FAMILY;
  question.head.nlmsg_flags = NLM_F_REQUEST;
  inet_diag_req_v2& request = question.request;
  request.sdiag_family = static_cast<std::uint8_t>(peer.address().is_v4() ? AF_INET : AF_INET6);
  request.sdiag_protocol = IPPROTO_TCP;
  request.idiag_states = ~0U;
  request.id.idiag_sport = htons(peer.port());
  request.id.idiag_dport = htons(own.port());
  CopyAddress(peer.address(), request.id.idiag_src);
  CopyAddress(own.address(), request.id.idiag_dst);
  request.id.idiag_cookie[0] = INET_DIAG_NOCOOKIE;
  request.id.idiag_cookie[1] = INET_DIAG_NOCOOKIE;
  return question;
}

}  // namespace

std::optional<std::uint32_t> UserOfPeer(const boost::asio::ip::tcp::socket& socket) {
  boost::system::error_code error;
  const Endpoint peer = socket.remote_endpoint(error);
  if (error || !peer.address().is_loopback()) return {};
  const Endpoint own = socket.local_endpoint(error);
  if (error) return {};
  const FileDescriptor netlink(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_SOCK_DIAG));
  if (!netlink.is_open()) return {};
  const Question question = QuestionFor(peer, own);
  if (send(netlink.number(), &question, sizeof question, 0) < 0) return {};
  alignas(nlmsghdr) char answer[4096];
  // The answer is there when send() returns: the kernel has made it meanwhile.
  const ssize_t size = recv(netlink.number(), answer, sizeof answer, MSG_DONTWAIT);
  nlmsghdr head{};
  inet_diag_msg found{};
  if (size < static_cast<ssize_t>(NLMSG_LENGTH(sizeof found))) return {};
  std::memcpy(&head, answer, sizeof head);
  std::memcpy(&found, answer + NLMSG_HDRLEN, sizeof found);
  if (head.nlmsg_type != SOCK_DIAG_BY_FAMILY) return {};
  // A socket that its process has closed belongs to nobody any more, which looks as if it were the system's.
  if (found.idiag_inode == 0) return {};
  return found.idiag_uid;
}

}  // namespace runnel::internal
