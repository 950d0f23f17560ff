#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/types/type_info.h"

namespace runnel {

/// Values of one type made one: all numbers in them are weighted and added, those that are angles (unit rad) as unit
/// vectors; what is no number (a name, a truth value) is the winner's.
///
/// Allocation:  Make() only. Threads: one at a time.
class ValueFusion {
 public:
  /// For up to so many values of the type; `unit` of a type that is a number itself. Errors: the values have texts,
  /// lists of any length or what nobody may look at in them.
  static Result<ValueFusion> Make(const TypeInfo& type, const std::string& unit, std::size_t values);

  /// `values`: one for each weight; nullptr where the weight is 0. That of the winner is there.
  void Fuse(std::span<const double> weights, std::span<const void* const> values, std::size_t winner,
            void* fused);

 private:
  /// A number somewhere in the values, so many bytes behind their beginning: they have no parts elsewhere.
  struct Number {
    std::size_t offset;
    const TypeInfo* type;
    bool is_angle;
  };

  explicit ValueFusion(const TypeInfo& type) : type_(&type) {}
  /// The numbers in the part `at` of `value`.
  Result<void> AddNumbers(const TypeInfo& type, const std::string& unit, void* at, const void* value);

  const TypeInfo* type_;
  std::vector<Number> numbers_;
  std::vector<double> found_;
};

}  // namespace runnel
