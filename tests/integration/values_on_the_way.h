#pragma once

#include <string>
#include <vector>

namespace runnel::test {

/// Makes a value one that says less than it should.
using Spoil = void (*)(void*);

/// A value on the way to the wheels.
struct OnTheWay {
  std::string output;  ///< as changes name it
  std::string input;   ///< that it goes to
  std::string source;  ///< the module that publishes it
  Spoil no_number = nullptr;
  Spoil not_measured = nullptr;
  Spoil partly = nullptr;  ///< not measured
  /// After 4 s without coming nearer, another behaviour drives, by measurements of its own.
  bool has_stand_in = false;
};
struct Demo {
  std::string file;
  std::vector<OnTheWay> values;
  /// Who has to be sent: an activity, and its arguments.
  std::string activity = {};
  std::string arguments = {};
};

/// The demonstrations that drive in one process, each with all on the way from its sensors to its wheels.
[[nodiscard]] std::vector<Demo> Demos();

}  // namespace runnel::test
