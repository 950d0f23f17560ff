#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <typeinfo>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/result.h"
#include "core/element/annotation.h"
#include "core/types/type_of.h"

namespace runnel {

namespace internal {

/// One in each library: by its address they are told apart.
[[gnu::visibility("hidden")]] inline constinit char this_library = 0;

/// Whether there is a description of T, also of the elements of lists, which all lists seem to have.
template <typename T>
inline constexpr bool kIsDescribed = Described<T>;
template <typename E>
inline constexpr bool kIsDescribed<std::vector<E>> = kIsDescribed<E>;
template <typename E, std::size_t count>
inline constexpr bool kIsDescribed<std::array<E, count>> = kIsDescribed<E>;
template <typename E>
inline constexpr bool kIsDescribed<std::optional<E>> = kIsDescribed<E>;

/// One state of a module, and how the library that the module comes from copies it and describes it.
struct KeptPart {
  const std::type_info* type;
  const char* library;
  void* state;
  void (*copy)(void* to, const void* from);
  const TypeInfo& (*description)();  // nullptr if it has none; throws what TypeOf() throws
};

}  // namespace internal

/// What a module remembers from cycle to cycle and leaves to a module that takes its place, if that
/// remembers something of the same type. Filled by Module::KeepState().
///
/// Between modules of one library a state is copied. A library that was built anew, or another one, may mean
/// something else by the same name, down to the bytes: to it a state goes by its description, field by field,
/// if both libraries have the same one.
///
/// Ownership:  of nothing; the states are members of the module.
/// Threads:    handed over while neither of the two modules runs.
class KeptState final : public Annotation {
 public:
  // Hidden, so that each library has its own.
  template <typename State>
  [[gnu::visibility("hidden")]] void Add(State& state) {
    const TypeInfo& (*description)() = nullptr;
    if constexpr (internal::kIsDescribed<State>) description = &TypeOf<State>;
    parts_.push_back({&typeid(State), &internal::this_library, &state,
                      [](void* to, const void* from) { *static_cast<State*>(to) = *static_cast<const State*>(from); },
                      description});
  }

  /// Which parts of `from` cannot be handed over to the part of the same type here, and why: they come from
  /// another library and have no description, one that leaves something open, or not the same. Throws for
  /// lack of memory.
  [[nodiscard]] std::vector<Error> Refusals(const KeptState& from) const;

  /// Hands each part of `from` over to the part of the same type here, the first to the first, but for those
  /// that are refused. Returns how many there were. Throws what copying throws, and an ElementError if a value
  /// cannot be described; parts may have been handed over by then.
  std::size_t TakeOver(const KeptState& from);

 private:
  struct Pair {
    const internal::KeptPart* from;
    const internal::KeptPart* to;
  };
  [[nodiscard]] std::vector<Pair> Match(const KeptState& from) const;

  std::vector<internal::KeptPart> parts_;
};

/// "Something of me goes on beside cycles": called of both modules before ports and kept states of one go to the one that
/// takes its place, so that what it still publishes is read, nobody uses the ports, and nothing changes while it is copied.
/// Neither module runs then. What is returned is kept until the ports are where they are to be. If the change is taken back,
/// the module runs again.
///
/// Threads: under the structure lock. Errors: what it throws has the change refused.
struct BeforeHandOver final : Annotation {
  using Held = std::shared_ptr<void>;
  explicit BeforeHandOver(std::function<Held()> what) : settle(std::move(what)) {}
  const std::function<Held()> settle;
};

}  // namespace runnel
