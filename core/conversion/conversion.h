#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/result.h"
#include "core/conversion/value_part.h"
#include "core/types/type_of.h"

namespace runnel {

/// What is to become of values on their way from one port to another.
struct ConversionRequest {
  const TypeInfo& from;
  const TypeInfo& to;
  std::string part = {};  ///< of the values: "x", "ranges[0]"; "" for all of them
  std::string name = {};  ///< which conversion; "" for one by which nothing is lost
  std::string from_unit = {};
  std::string to_unit = {};
};

/// How values of one type become values of another; found out once, when ports are connected. In this order:
///
///   a part            field, element: "pose.x", "ranges[0]"
///   the same type     copied; of numbers with two units, the one is turned into the other (rad to deg)
///   by name           what a plugin has registered; "round", "truncate" (numbers, kept within what the
///                     type can have), "parse" (a text is read)
///   without a name    number to number where nothing is lost; anything to a Signal; anything to a text;
///                     what a plugin has registered as usual
///
/// Threads: never changes once made; any.
class Conversion {
 public:
  /// Writes what `from` becomes to `to`; false if it becomes nothing: an element that is not there, a text that
  /// cannot be read. Allocates if texts or lists are made, and not otherwise. Does not throw.
  using Convert = std::function<bool(const void* from, void* to)>;

  /// Errors: nothing leads from the one to the other, with what would.
  [[nodiscard]] static Result<std::shared_ptr<const Conversion>> Find(const ConversionRequest& request);

  /// One of whole values that somebody else knows how to make.
  [[nodiscard]] static std::shared_ptr<const Conversion> Of(const TypeInfo& from, Convert convert);

  [[nodiscard]] bool operator()(const void* from, void* to) const noexcept;
  /// For people: "x, rad to deg, round".
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  ValuePart part_;
  Convert convert_;
  std::string text_;
};

/// A conversion that somebody has registered.
struct RegisteredConversion {
  std::string name;  ///< what <connect convert="…"> says
  const TypeInfo* from = nullptr;
  const TypeInfo* to = nullptr;
  Conversion::Convert convert;
  std::string summary = {};
  bool is_usual = false;  ///< taken without being named, too
};

/// For plugins, when they are loaded: connections may use it from then on, in all applications of the process.
/// The same name between the same types again takes the place of the one before. Locks.
void RegisterConversion(RegisteredConversion conversion);

/// The same for a `convert(const From&, To&)` that returns nothing, or whether there is a result.
template <typename From, typename To, typename Function>
void RegisterConversion(std::string name, Function convert, std::string summary = {}, bool is_usual = false) {
  RegisterConversion({.name = std::move(name),
                      .from = &TypeOf<From>(),
                      .to = &TypeOf<To>(),
                      .convert =
                          [convert = std::move(convert)](const void* from, void* to) {
                            const auto& value = *static_cast<const From*>(from);
                            auto& result = *static_cast<To*>(to);
                            if constexpr (std::is_void_v<decltype(convert(value, result))>) {
                              convert(value, result);
                              return true;
                            } else {
                              return static_cast<bool>(convert(value, result));
                            }
                          },
                      .summary = std::move(summary),
                      .is_usual = is_usual});
}

/// What has been registered, in the order of names. Locks.
[[nodiscard]] std::vector<RegisteredConversion> RegisteredConversions();

/// One way by which values of a type could become those of another.
struct ConversionCandidate {
  std::string part;  ///< "pose.x"; that of the request if nothing else has been found
  std::string name;  ///< what <connect convert="…"> would say; "": nothing

  /// As it is to be said: "from=\"….x\"", "convert=\"round\"".
  [[nodiscard]] std::string text() const;
};

/// What would lead from the one to the other. At most `most`.
[[nodiscard]] std::vector<ConversionCandidate> ConversionCandidates(const ConversionRequest& request,
                                                                    std::size_t most = 4);

}  // namespace runnel
