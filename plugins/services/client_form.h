#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/element/annotation.h"
#include "plugins/services/argument_type.h"

namespace runnel {

/// What a client asks and is answered, for those who carry its calls elsewhere without knowing its types.
///
/// Threads: any; a call as call.h says.
class CallForm {
 public:
  virtual ~CallForm() = default;
  /// A structure with a field for each argument, or the only argument itself; nullptr: none.
  [[nodiscard]] virtual const TypeInfo* arguments() const = 0;
  /// nullptr: nothing but that it has been done.
  [[nodiscard]] virtual const TypeInfo* reply() const = 0;
  /// Whether arguments() is such a structure.
  [[nodiscard]] virtual bool is_named() const = 0;
  [[nodiscard]] virtual const void* ArgumentsOf(const CallBase& call) const = 0;
  [[nodiscard]] virtual void* ReplyOf(CallBase& call) const = 0;
};

template <typename Signature>
class CallFormOf;
template <typename Reply, typename... Arguments>
class CallFormOf<Reply(Arguments...)> final : public CallForm {
 public:
  using Slot = Call<Reply(Arguments...)>;
  explicit CallFormOf(const std::vector<std::string>& names) : arguments_(names) {}

  [[nodiscard]] const TypeInfo* arguments() const override { return arguments_.Get(); }
  [[nodiscard]] const TypeInfo* reply() const override {
    if constexpr (std::is_void_v<Reply>) {
      return nullptr;
    } else {
      return &TypeOf<Reply>();
    }
  }
  [[nodiscard]] bool is_named() const override { return arguments_.is_named(); }
  [[nodiscard]] const void* ArgumentsOf(const CallBase& call) const override {
    return &static_cast<const Slot&>(call).arguments;
  }
  [[nodiscard]] void* ReplyOf(CallBase& call) const override { return &static_cast<Slot&>(call).reply; }

 private:
  const ArgumentType<Arguments...> arguments_;
};

/// The annotation of a client's port. The form outlives the client, for calls that are still under way.
struct ClientForm final : Annotation {
  explicit ClientForm(std::shared_ptr<const CallForm> of) : form(std::move(of)) {}
  const std::shared_ptr<const CallForm> form;
};

}  // namespace runnel
