#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "core/element/annotation.h"
#include "core/port/output.h"
#include "plugins/services/call.h"
#include "plugins/services/call_record.h"

namespace runnel {

/// What the arguments of calls are called and of which types they are: a structure with a field for each, or the only
/// argument itself if nobody gave it a name. The names are those of one service or client, so their type is described here,
/// and not for the whole process.
template <typename... Arguments>
class ArgumentType {
 public:
  using Pack = ArgumentPack<Arguments...>;

  /// `names`: of all arguments, or none. Errors: others throw ProgrammingError.
  explicit ArgumentType(const std::vector<std::string>& names)
      : is_named_(!(names.empty() && sizeof...(Arguments) == 1)) {
    RUNNEL_CHECK(names.empty() || names.size() == sizeof...(Arguments), "a service names all of its arguments or none");
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

/// Publishes what has come of the calls of one service.
class CallRecorder {
 public:
  virtual ~CallRecorder() = default;
  /// Nothing, if nobody looks.
  virtual void Record(const CallBase& call, CallStatus status) = 0;
};

/// One signature of services, Reply(Arguments…), for those who offer or use such a service without having been compiled
/// with it.
///
/// Threads: any; what it makes, as there.
class ServiceSignature {
 public:
  /// `names`: of all arguments, or none.
  [[nodiscard]] virtual std::shared_ptr<const CallForm> MakeForm(const std::vector<std::string>& names) const = 0;
  [[nodiscard]] virtual std::unique_ptr<CallSlots> MakeSlots(std::size_t count) const = 0;
  /// With an output SERVICE_calls. nullptr: there are no records of this signature.
  [[nodiscard]] virtual std::unique_ptr<CallRecorder> MakeRecorder(FrameworkElement& group,
                                                                   const std::string& service) const = 0;
  /// `record` is one of this signature.
  virtual void TakeArguments(const CallRecordBase& record, CallBase& call) const = 0;

 protected:
  ~ServiceSignature() = default;
};

namespace internal {

// `has_records`: in place of one that has none.
void AddServiceSignature(const TypeInfo& link, const ServiceSignature& signature, bool has_records);

template <typename Signature>
class CallRecorderOf final : public CallRecorder {
 public:
  CallRecorderOf(FrameworkElement& group, const std::string& service)
      : records_(group, service + "_calls", {.description = "what has come of each call of " + service, .pool = {}}) {}
  void Record(const CallBase& call, CallStatus status) override {
    PublishRecord(records_, static_cast<const Call<Signature>&>(call), status);
  }

 private:
  Output<CallRecord<Signature>> records_;
};

template <typename Signature, bool has_records>
class ServiceSignatureOf final : public ServiceSignature {
 public:
  [[nodiscard]] std::shared_ptr<const CallForm> MakeForm(const std::vector<std::string>& names) const override {
    return std::make_shared<CallFormOf<Signature>>(names);
  }
  [[nodiscard]] std::unique_ptr<CallSlots> MakeSlots(std::size_t count) const override {
    return std::make_unique<CallSlotsOf<Signature>>(count);
  }
  [[nodiscard]] std::unique_ptr<CallRecorder> MakeRecorder([[maybe_unused]] FrameworkElement& group,
                                                           [[maybe_unused]] const std::string& service) const override {
    if constexpr (has_records) {
      return std::make_unique<CallRecorderOf<Signature>>(group, service);
    } else {
      return nullptr;
    }
  }
  void TakeArguments(const CallRecordBase& record, CallBase& call) const override {
    static_cast<Call<Signature>&>(call).arguments = static_cast<const CallRecord<Signature>&>(record).arguments;
  }
};

/// Called when a service or a client is made. Clients spare themselves the code of records.
template <typename Signature, bool has_records>
[[gnu::noinline]] const ServiceSignature& MakeServiceSignatureKnown() {
  static const ServiceSignatureOf<Signature, has_records> signature;
  static const bool is_known = (AddServiceSignature(TypeOf<ServiceLink<Signature>>(), signature, has_records), true);
  (void)is_known;
  return signature;
}

}  // namespace internal

}  // namespace runnel
