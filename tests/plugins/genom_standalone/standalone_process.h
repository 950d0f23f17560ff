#pragma once

#include <initializer_list>
#include <string>

#include <nlohmann/json.hpp>
#include <sys/types.h>

#include "tests/support/temporary_folder.h"

namespace runnel::test {

using Json = nlohmann::ordered_json;

/// A component as a process, and a client of its socket.
class StandaloneProcess {
 public:
  /// Returns when it listens.
  explicit StandaloneProcess(const std::string& program, std::initializer_list<const char*> options = {});
  /// Kills it, if it still runs.
  ~StandaloneProcess();
  StandaloneProcess(const StandaloneProcess&) = delete;
  StandaloneProcess& operator=(const StandaloneProcess&) = delete;

  void Say(const std::string& line);
  /// Says this without the end of a line, and that nothing more comes.
  void SayLast(const std::string& text);
  /// The next line that it says; a JSON text "gone" if it is gone.
  [[nodiscard]] Json Hear();
  /// Says the line, and hears one.
  [[nodiscard]] Json Ask(const Json& line) {
    Say(line.dump());
    return Hear();
  }
  void Send(int signal) const;
  /// From now on it gets so many bytes more.
  void LimitMemory(std::size_t more) const;
  /// How it ended: its exit code, or minus the signal.
  [[nodiscard]] int Wait();
  [[nodiscard]] bool has_socket() const;

 private:
  void SendAll(const std::string& text);

  TemporaryFolder folder_;
  pid_t process_ = -1;
  int socket_ = -1;
  std::string received_;
};

}  // namespace runnel::test
