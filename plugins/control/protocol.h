#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "core/base/clock.h"
#include "core/base/result.h"

namespace runnel {

/// What goes over a control socket, in both directions: "kind length\n", so many bytes, "\n".
struct Frame {
  std::string kind;  ///< a lower-case word
  std::string payload;
};

[[nodiscard]] std::string FrameBytes(std::string_view kind, std::string_view payload);

/// Puts frames together from bytes as they come.
///
/// Threads:  one. Memory: no more than what was added since the last Take(), and one frame.
class FrameReader {
 public:
  static constexpr std::size_t kLongestKind = 16;

  /// Refuses frames with more than `longest` bytes before they have come.
  explicit FrameReader(std::size_t longest) : longest_(longest) {}

  void Add(std::string_view bytes) { bytes_ += bytes; }
  /// The next one, if all of it is there. Errors: what has come is no frame; there is no way on then.
  [[nodiscard]] Result<std::optional<Frame>> Take();

 private:
  const std::size_t longest_;
  std::string bytes_;
  std::size_t at_ = 0;
};

/// What a client asks for: a command with its arguments in a line, and, if it has more lines, a text.
///
///     echo /robot/planner/pose count=3
///     change file=plan.txt
///     connect /a/out /b/in
///     delete /c
struct Request {
  std::string command;
  std::vector<std::string> arguments;
  std::map<std::string, std::string> options;
  std::string body;

  /// Errors: the first line cannot be split into arguments, or has an option twice.
  [[nodiscard]] static Result<Request> Parse(std::string_view text);
  [[nodiscard]] std::string ToText() const;

  [[nodiscard]] bool Has(const std::string& option) const { return options.count(option) > 0; }
  [[nodiscard]] std::string Option(const std::string& option) const;
};

/// Which protocol this code speaks. Changes when a client of before would misunderstand.
inline constexpr int kControlProtocol = 1;

/// The first frame that a client gets: whom it has reached.
struct Hello {
  int protocol = kControlProtocol;
  pid_t process = 0;
  std::string application = {};
  std::string file = {};
  Duration time{};              ///< that the application has been running, on its own clock
  Duration real{};              ///< the same on the machine's
  bool is_asking_when = false;  ///< operators must be heard: each request is to have an "at" before it
  std::string state = {};       ///< "running", "paused", "ended", "running, 2 modules FAILED"; "": not known

  [[nodiscard]] std::string ToText() const;
  /// Errors: another protocol, or no hello at all.
  [[nodiscard]] static Result<Hello> Parse(std::string_view text);
};

}  // namespace runnel
