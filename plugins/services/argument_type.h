#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "plugins/services/call.h"

namespace runnel {

/// What the arguments of calls are called and of which types they are: a structure with a field for each, or the only
/// argument itself if nobody gave it a name. The names are those of one service or client, so their type is described here,
/// and not for the whole process.
template <typename... Arguments>
class ArgumentType {
 public:
  using Pack = ArgumentPack<Arguments...>;

  /// `names`: of all arguments, or none. Errors: others throw ProgrammingError.
  explicit ArgumentType(const std::vector<std::string>& names) : is_named_(!(names.empty() && sizeof...(Arguments) == 1)) {
    RUNNEL_CHECK(names.empty() || names.size() == sizeof...(Arguments),
                 "a service names all of its arguments or none");
    if constexpr (sizeof...(Arguments) > 0) {
      if (is_named_) DescribeAll(names, std::index_sequence_for<Arguments...>());
    }
  }

  /// Whether it is a structure with a field for each.
  [[nodiscard]] bool is_named() const noexcept { return is_named_; }
  /// nullptr if there are none.
  [[nodiscard]] const TypeInfo* Get() const {
    if constexpr (sizeof...(Arguments) == 0) return nullptr;
    if constexpr (sizeof...(Arguments) == 1) {
      if (!is_named_) return &TypeOf<std::remove_cvref_t<Arguments>...>();
    }
    return &type_;
  }

 private:
  template <std::size_t... index>
  void DescribeAll(const std::vector<std::string>& names, std::index_sequence<index...>) {
    TypeBuilder<Pack> type(type_);
    type.Name("arguments");
    (type.Field(names.empty() ? "argument" + std::to_string(index + 1) : names[index],
                &internal::ArgumentOf<index, std::remove_cvref_t<Arguments>>::value),
     ...);
  }

  const bool is_named_;
  TypeInfo type_{typeid(Pack)};
};

}  // namespace runnel
