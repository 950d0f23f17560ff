#pragma once

#include <array>
#include <csignal>
#include <functional>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace runnel::test {

/// Another process, with a pipe to it and one from it; it ends with this one. Precondition: this one has no threads yet.
class Child {
 public:
  /// `run` is what it does, until it ends or is killed. `user`: whose it is; 0: whose this one is.
  explicit Child(const std::function<void(int from, int to)>& run, uid_t user = 0) {
    std::array<int, 2> there{}, back{};
    if (pipe2(there.data(), O_CLOEXEC) != 0 || pipe2(back.data(), O_CLOEXEC) != 0) return;
    id_ = fork();
    if (id_ == 0) {
      if (user != 0 && (setgid(user) != 0 || setuid(user) != 0)) _exit(1);
      (void)prctl(PR_SET_PDEATHSIG, SIGKILL);  // which another user would make void
      close(there[1]);
      close(back[0]);
      run(there[0], back[1]);
      _exit(1);
    }
    close(there[0]);
    close(back[1]);
    to_ = there[1];
    from_ = back[0];
  }
  ~Child() {
    Kill();
    close(to_);
    close(from_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void Kill() {
    if (id_ > 0 && kill(id_, SIGKILL) == 0) waitpid(id_, nullptr, 0);
    id_ = 0;
  }
  /// Until it stands still.
  void Stop() const {
    (void)kill(id_, SIGSTOP);
    waitpid(id_, nullptr, WUNTRACED);
  }
  void GoOn() const { (void)kill(id_, SIGCONT); }
  [[nodiscard]] pid_t process() const { return id_; }
  [[nodiscard]] int to() const { return to_; }
  /// Waits for the octet that it says next; 0: it has ended, or says nothing for a minute.
  [[nodiscard]] char Said() const {
    constexpr int kPatience = 60'000;  // ms
    pollfd more{from_, POLLIN, 0};
    char octet = 0;
    return poll(&more, 1, kPatience) == 1 && read(from_, &octet, 1) == 1 ? octet : '\0';
  }
  [[nodiscard]] bool HasSaidSo() const { return Said() != '\0'; }

 private:
  pid_t id_ = -1;
  int to_ = -1;
  int from_ = -1;
};

}  // namespace runnel::test
