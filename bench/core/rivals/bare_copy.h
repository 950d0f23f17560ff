#pragma once

namespace runnel::bench {

/// The floor: the value is copied in and out, and nothing makes that safe between threads.
template <typename T>
class BareCopy {
 public:
  static constexpr const char* kName = "bare copy (one thread only)";

  void Write(const T& value) { value_ = value; }
  void Read(T& value) { value = value_; }

 private:
  alignas(64) T value_{};
};

}  // namespace runnel::bench
