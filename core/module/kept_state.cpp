#include "core/module/kept_state.h"

#include <cstring>
#include <string>

#include "core/base/call_stack.h"
#include "core/base/check.h"
#include "core/element/framework_element.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {

using internal::KeptPart;

std::string NameOf(const KeptPart& part) { return Demangled(part.type->name()); }

// Why the state cannot go from the one library to the other; nullopt if it can.
std::optional<Error> Refusal(const KeptPart& from, const KeptPart& to) {
  if (from.library == to.library) return {};
  const auto refused = [&](const std::string& why, const std::string& hint) {
    return Error{.message = "the kept state '" + NameOf(from) + "' cannot be handed over to another library: " + why,
                 .hint = hint};
  };
  if (from.description == nullptr || to.description == nullptr) {
    return refused("its type has no description",
                   "write a Describe(runnel::TypeBuilder<…>&) beside the type, or delete the module before "
                   "and create it again after");
  }
  try {
    const TypeInfo& type = from.description();
    // Throws if the other library means something else by the type, or by one inside of it.
    (void)to.description();
    if (type.is_transparent()) return {};
    return refused("something in it is not described", "describe the fields of all that is in it");
  } catch (const ProgrammingError& otherwise) {
    return refused(otherwise.what(), "delete the module before and create it again after: what it remembers is lost");
  }
}

void HandOver(const KeptPart& from, const KeptPart& to) {
  if (from.library == to.library) return to.copy(to.state, from.state);
  if (CopyValue(from.description(), from.state, to.state)) return;
  throw ElementError({.message = "'" + NameOf(from) + "' has a list that cannot be made as long"});
}

}  // namespace

std::vector<KeptState::Pair> KeptState::Match(const KeptState& from) const {
  std::vector<Pair> pairs;
  std::vector<bool> used(from.parts_.size());
  for (const KeptPart& part : parts_) {
    for (std::size_t i = 0; i < used.size(); ++i) {
      // By name: each library may have a std::type_info of its own.
      if (used[i] || std::strcmp(part.type->name(), from.parts_[i].type->name()) != 0) continue;
      pairs.push_back({&from.parts_[i], &part});
      used[i] = true;
      break;
    }
  }
  return pairs;
}

std::vector<Error> KeptState::Refusals(const KeptState& from) const {
  std::vector<Error> refusals;
  for (const Pair& pair : Match(from)) {
    if (auto refusal = Refusal(*pair.from, *pair.to)) refusals.push_back(std::move(*refusal));
  }
  return refusals;
}

std::size_t KeptState::TakeOver(const KeptState& from) {
  std::size_t taken = 0;
  for (const Pair& pair : Match(from)) {
    if (Refusal(*pair.from, *pair.to)) continue;
    HandOver(*pair.from, *pair.to);
    ++taken;
  }
  return taken;
}

}  // namespace runnel
