#pragma once

#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace runnel {

/// A place in a text file. Lines and columns count from 1; 0 means unknown.
///
/// Has constructors, unlike Error, since GCC 12 destroys a braced aggregate within another one twice if what
/// comes behind it throws.
struct SourcePosition {
  SourcePosition() = default;
  SourcePosition(std::string in_file, int at_line = 0, int at_column = 0)
      : file(std::move(in_file)), line(at_line), column(at_column) {}

  std::string file;
  int line = 0;
  int column = 0;

  friend bool operator==(const SourcePosition&, const SourcePosition&) = default;
};

/// Something that a user got wrong, told so that the user can mend it: what, where, and the cure.
///
/// Threads: a value; copies are independent.
struct Error {
  std::string message;           ///< one sentence, without a full stop
  std::string path = {};         ///< of the framework element concerned, "" if none
  SourcePosition position = {};  ///< in the user's file, if the error comes from one
  std::string hint = {};         ///< the cure, for example "did you mean 'scan'?"; "" if unknown

  /// "file:line:column: path: message; hint", leaving out what is unknown.
  [[nodiscard]] std::string ToString() const;

  /// The same error, "context: message": what has failed by it, or where in the input it is.
  [[nodiscard]] Error WithContext(std::string_view context) const;
  /// The same error, of the element at `of` unless it names one itself.
  [[nodiscard]] Error WithPath(std::string_view of) const;
  /// The same error, at the place `at` unless it names one itself.
  [[nodiscard]] Error WithPosition(SourcePosition at) const;

  friend bool operator==(const Error&, const Error&) = default;
};

/// What a call of the system that has just failed says by `errno`: "what: why".
[[nodiscard]] Error SystemError(std::string_view what, std::string file = {});

/// Collects all that is wrong with a user's input, so that it is told at once rather than one by
/// one. Warnings never make an input wrong.
///
/// Threads: not thread-safe.
class Diagnostics {
 public:
  void Add(Error error) { errors_.push_back(std::move(error)); }
  void AddWarning(Error warning) { warnings_.push_back(std::move(warning)); }

  [[nodiscard]] bool ok() const noexcept { return errors_.empty(); }
  [[nodiscard]] const std::vector<Error>& errors() const noexcept { return errors_; }
  [[nodiscard]] const std::vector<Error>& warnings() const noexcept { return warnings_; }

  /// One line each, errors first, ordered by place in the file within each kind:
  /// "file:3:5: error: /robot: …".
  [[nodiscard]] std::string ToString() const;

 private:
  std::vector<Error> errors_;
  std::vector<Error> warnings_;
};

/// What an exception says, for those who catch whatever other people's code throws: the text of a
/// std::exception, of a string or of a C string, else the name of the type that was thrown.
///
///     } catch (...) {
///       Report("the handler failed: " + DescribeException());
///     }
///
/// Threads:    any. Allocation: of the text; without memory it is "out of memory".
/// Errors:     none; outside of a handler it is "no exception".
[[nodiscard]] std::string DescribeException(std::exception_ptr exception = std::current_exception()) noexcept;

}  // namespace runnel
