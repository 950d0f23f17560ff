#pragma once

#include <string>

#include <sys/types.h>

namespace runnel::test {

/// How it ends.
inline constexpr int kDone = 0, kRunFailed = 1, kBadInput = 2;

/// The first of its arguments for the shipped application.
inline const std::string kDemo = std::string(RUNNEL_XML) + "/apps/bug_demo.xml ";

/// How the program ended, and all that it wrote to standard output and errors.
struct Ended {
  int code = -1;   ///< -1: it did not end by itself
  int signal = 0;  ///< that ended it; 0: none
  std::string text;
};

/// The program, started as a shell starts it, without the right to real-time scheduling; finds the
/// plugins of the tests, too.
class Program {
 public:
  /// `arguments` may redirect its output.
  explicit Program(const std::string& arguments, const std::string& program = RUNNEL_PROGRAM);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Until it has written `text`. False if it ends without.
  bool WaitFor(const std::string& text);
  /// Until it does (or does not) handle the signal itself. Preconditions: it does so before it
  /// ends; its start is not waited for by SIGINT, which the shell before it handles, too.
  void WaitUntilHandles(int signal, bool handles) const;
  void Send(int signal) const;
  [[nodiscard]] pid_t process() const noexcept { return process_; }
  /// The files in its memory, as the system lists them.
  [[nodiscard]] std::string Maps() const;
  /// Until it has ended. Once.
  Ended Wait();

 private:
  bool ReadMore();
  [[nodiscard]] bool Handles(int signal) const;

  pid_t process_ = -1;
  int output_ = -1;
  std::string text_;
};

/// From its start to its end.
[[nodiscard]] Ended Runnel(const std::string& arguments);

}  // namespace runnel::test
