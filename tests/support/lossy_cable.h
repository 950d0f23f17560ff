#pragma once

#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace runnel::test {

/// A cable between the network of the calling thread (10.78.0.1) and that of another process (10.78.0.2), which loses
/// frames, those that a sequence of random numbers says, and is long: what tc netem does, where a kernel has that.
class LossyCable {
 public:
  struct Manner {
    double loss = 0.05;
    std::chrono::milliseconds delay{100};
    unsigned seed = 1;
  };

  LossyCable(pid_t other, Manner manner) : manner_(manner), random_(manner.seed) {
    ends_[0] = Open("cable");
    const std::string within = "nsenter -t " + std::to_string(other) + " --net ";
    // Who opens an end is in its network; the end may be used from anywhere.
    std::thread([&] {
      const int network = open(("/proc/" + std::to_string(other) + "/ns/net").c_str(), O_RDONLY | O_CLOEXEC);
      if (network >= 0 && setns(network, CLONE_NEWNET) == 0) ends_[1] = Open("end");
      if (network >= 0) close(network);
    }).join();
    const auto run = [](const std::string& command) { return std::system((command + " 2>/dev/null").c_str()) == 0; };
    is_there_ = ends_[0] >= 0 && ends_[1] >= 0 && run("ip addr add 10.78.0.1/24 dev cable && ip link set cable up") &&
                run(within + "ip addr add 10.78.0.2/24 dev end") && run(within + "ip link set end up");
    thread_ = std::thread([this] { Carry(); });
  }
  ~LossyCable() {
    const std::uint64_t one = 1;
    if (write(stop_, &one, sizeof one) < 0) std::abort();
    thread_.join();
    for (const int each : {ends_[0], ends_[1], stop_}) {
      if (each >= 0) close(each);
    }
  }
  LossyCable(const LossyCable&) = delete;
  LossyCable& operator=(const LossyCable&) = delete;

  /// False: the system does not permit it.
  [[nodiscard]] bool is_there() const noexcept { return is_there_; }

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;
  struct Frame {
    SteadyTime due;
    int to;
    std::vector<char> octets;
  };

  static int Open(const char* name) {
    const int end = open("/dev/net/tun", O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (end < 0) return -1;
    ifreq request{};
    std::strcpy(request.ifr_name, name);
    request.ifr_flags = IFF_TAP | IFF_NO_PI;
    if (ioctl(end, TUNSETIFF, &request) == 0) return end;
    close(end);
    return -1;
  }
  void Carry() {
    std::vector<char> room(70'000);
    while (true) {
      const auto now = std::chrono::steady_clock::now();
      int wait = -1;
      if (!frames_.empty()) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(frames_.front().due - now).count();
        wait = static_cast<int>(std::max<long>(0, left + 1));
      }
      std::array<pollfd, 3> ends{{{ends_[0], POLLIN, 0}, {ends_[1], POLLIN, 0}, {stop_, POLLIN, 0}}};
      if (poll(ends.data(), ends.size(), wait) < 0) continue;
      if (ends[2].revents != 0) return;
      for (std::size_t i = 0; i < 2; ++i) {
        const ssize_t size = ends[i].revents != 0 ? read(ends_[i], room.data(), room.size()) : 0;
        if (size <= 0) continue;
        if (std::uniform_real_distribution<double>()(random_) < manner_.loss) continue;
        frames_.push_back(
            {std::chrono::steady_clock::now() + manner_.delay, ends_[1 - i], {room.begin(), room.begin() + size}});
      }
      while (!frames_.empty() && frames_.front().due <= std::chrono::steady_clock::now()) {
        const Frame& frame = frames_.front();
        (void)!write(frame.to, frame.octets.data(), frame.octets.size());
        frames_.pop_front();
      }
    }
  }

  const Manner manner_;
  std::mt19937 random_;
  std::array<int, 2> ends_{-1, -1};
  const int stop_ = eventfd(0, EFD_CLOEXEC);
  bool is_there_ = false;
  std::deque<Frame> frames_;
  std::thread thread_;
};

}  // namespace runnel::test
