#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/types/type_of.h"

namespace runnel {

/// One element of a list, as it shall be.
template <typename E>
struct ElementChange {
  std::uint64_t index = 0;
  E value{};
};
template <typename E>
void Describe(TypeBuilder<ElementChange<E>>& type) {
  using Change = ElementChange<E>;
  type.Name("change of " + TypeOf<E>().name()).Field("index", &Change::index).Field("value", &Change::value);
}

/// What a change set of T is, if nobody says otherwise: of a list some of its elements, else the whole value. A kind of
/// change of one's own is any described type with a function `Result<void> Apply(T&, const Change&)` beside it.
template <typename T>
struct UsualChange {
  using Type = T;
};
template <typename E>
struct UsualChange<std::vector<E>> {
  using Type = std::vector<ElementChange<E>>;
};

/// Changes `value`, or says what is wrong; it may be half changed then.
template <typename E>
Result<void> Apply(std::vector<E>& value, const std::vector<ElementChange<E>>& changes) {
  for (const ElementChange<E>& each : changes) {
    if (each.index >= value.size()) {
      return Error{.message = "there is no element " + std::to_string(each.index) + ", but " +
                              std::to_string(value.size()) + " in all"};
    }
    value[each.index] = each.value;
  }
  return {};
}
template <typename T>
Result<void> Apply(T& value, const std::type_identity_t<T>& whole) requires std::is_copy_assignable_v<T> {
  value = whole;
  return {};
}

/// A change set on its way to the owner.
template <typename Change>
struct CommitRequest {
  /// Which revision it was made for; 0: whichever there is then.
  std::uint64_t revision = 0;
  Change change{};
};
template <typename Change>
void Describe(TypeBuilder<CommitRequest<Change>>& type) {
  using Request = CommitRequest<Change>;
  type.Name("commit of " + TypeOf<Change>().name())
      .Field("revision", &Request::revision, {.description = "for which it was made; 0: whichever"})
      .Field("change", &Request::change);
}

/// What has come of it.
struct CommitReply {
  bool is_applied = false;     ///< false: there is another revision by now, and nothing has changed
  std::uint64_t revision = 0;  ///< that there is now
};
inline void Describe(TypeBuilder<CommitReply>& type) {
  type.Name("CommitReply").Fields<&CommitReply::is_applied, &CommitReply::revision>();
}

}  // namespace runnel
