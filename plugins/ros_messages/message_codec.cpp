#include "plugins/ros_messages/message_codec.h"

#include <utility>

#include "core/types/type_info.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/ros_messages/internal/binding.h"
#include "plugins/ros_messages/internal/mapping_rules.h"
#include "plugins/ros_messages/internal/message_leaf.h"
#include "plugins/ros_messages/internal/occupancy_grid.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

namespace {

class NamedCodec : public MessageCodec {
 protected:
  NamedCodec(const MessageDefinition& definition, const MessageLibrary& library) {
    ros_type_ = definition.name;
    dds_type_ = DdsType(definition.name);
    type_hash_ = TypeHashOf(definition, library);
  }
};

/// The octets are those of the type's own description.
class DescribedCodec final : public NamedCodec {
 public:
  DescribedCodec(const TypeInfo& type, const MessageDefinition& definition, const MessageLibrary& library)
      : NamedCodec(definition, library), type_(type) {}

  void Encode(const void* value, Time /*stamp*/, std::vector<std::byte>& octets) const override {
    WriteCdr(type_, value, octets);
  }
  [[nodiscard]] Result<Decoded> Decode(std::span<const std::byte> octets, void* value,
                                       std::shared_ptr<const void> holder) const override {
    if (auto read = ReadCdr(type_, octets, value, std::move(holder)); !read) return read.error();
    return Decoded{};
  }

 private:
  const TypeInfo& type_;
};

/// The message has fields of its own, of which the value fills some.
class BoundCodec final : public NamedCodec {
 public:
  BoundCodec(const TypeInfo& type, internal::Binding binding, const MessageDefinition& definition,
             const MessageLibrary& library)
      : NamedCodec(definition, library), root_(std::move(binding.root)), fresh_(type.Make()) {
    left_out_ = std::move(binding.left_out);
    why_no_decoding_ = std::move(binding.why_no_decoding);
  }

  void Encode(const void* value, Time stamp, std::vector<std::byte>& octets) const override {
    CdrWriter writer(octets);
    internal::WriteBySteps(root_, value, stamp, writer);
  }
  [[nodiscard]] Result<Decoded> Decode(std::span<const std::byte> octets, void* value,
                                       std::shared_ptr<const void> holder) const override {
    if (!why_no_decoding_.empty()) return Error{.message = why_no_decoding_};
    auto reader = CdrReader::Begin(octets, std::move(holder));
    if (!reader) return reader.error();
    Decoded decoded;
    auto read = internal::ReadBySteps(root_, *reader, fresh_.get(), value, decoded.stamp);
    if (!read) return read.error();
    return decoded;
  }

 private:
  const internal::Step root_;
  const std::shared_ptr<const void> fresh_;
};

/// A ground plan as a grid, out of which no plan comes back.
class GridCodec final : public NamedCodec {
 public:
  GridCodec(const TypeInfo& type, const MessageOptions& options, const MessageDefinition& definition,
            const MessageLibrary& library)
      : NamedCodec(definition, library), type_(type), frame_(options.frame) {
    why_no_decoding_ = "a grid has no outlines, of which a " + type.name() + " is made";
  }

  void Encode(const void* value, Time stamp, std::vector<std::byte>& octets) const override {
    internal::WriteGrid(type_, value, stamp, frame_, octets);
  }
  [[nodiscard]] Result<Decoded> Decode(std::span<const std::byte> /*octets*/, void* /*value*/,
                                       std::shared_ptr<const void> /*holder*/) const override {
    return Error{.message = why_no_decoding_};
  }

 private:
  const TypeInfo& type_;
  const std::string frame_;
};

using Made = Result<std::shared_ptr<const MessageCodec>>;

Made MakeDescribed(const TypeInfo& type, const MessageLibrary& library) {
  MessageLibrary with_type = library;
  const auto definition = with_type.AddDescribed(type);
  if (!definition) return definition.error();
  return {std::make_shared<DescribedCodec>(type, **definition, with_type)};
}

Made MakeBound(const TypeInfo& type, const std::string& as, const MessageOptions& options,
               const MessageLibrary& library) {
  const auto definition = library.Get(as);
  if (!definition) return definition.error();
  const MessageField whole{.name = {}, .type = MessageType::kNested, .nested = (*definition)->name};
  if (internal::IsSame(whole, type, library)) {
    return {std::make_shared<DescribedCodec>(type, **definition, library)};
  }
  if ((*definition)->name == internal::kGridMessage && internal::CanBecomeGrid(type)) {
    return {std::make_shared<GridCodec>(type, options, **definition, library)};
  }
  auto binding = internal::Bind(**definition, type, options, library);
  if (!binding) return binding.error();
  return {std::make_shared<BoundCodec>(type, std::move(*binding), **definition, library)};
}

Made MakeField(const TypeInfo& type, const MessageOptions& options, const MessageLibrary& library) {
  if (options.as.empty()) {
    return Error{.message = "the field '" + options.field + "' is one of a message, and nobody says of which",
                 .hint = "say it: as=\"sensor_msgs/msg/BatteryState\""};
  }
  const auto definition = library.Get(options.as);
  if (!definition) return definition.error();
  auto binding = internal::BindField(**definition, type, options, library);
  if (!binding) return binding.error();
  return {std::make_shared<BoundCodec>(type, std::move(*binding), **definition, library)};
}

std::string DefaultMessageOf(const TypeInfo& type) {
  for (const internal::DefaultMessage& each : internal::kDefaultMessages) {
    if (each.semantic_tag == type.semantic_tag()) return std::string(each.message);
  }
  if (type.kind() == TypeKind::kSequence && type.elements().are_plain_numbers) {
    return MessageNameOf(*type.elements().type) + "MultiArray";
  }
  return "";
}

}  // namespace

Made MessageCodec::Make(const TypeInfo& type, const MessageOptions& options,
                        const MessageLibrary& library) {
  if (auto checked = CheckCdr(type); !checked) return checked.error();
  if (!options.field.empty()) return MakeField(type, options, library);
  if (options.by_description) return MakeDescribed(type, library);
  if (!options.as.empty()) {
    const bool is_own = library.Find(options.as) == nullptr && options.as == MessageNameOf(type);
    return is_own ? MakeDescribed(type, library) : MakeBound(type, options.as, options, library);
  }
  const std::string fitting = DefaultMessageOf(type);
  const std::string& own = MessageNameOf(type);
  if (!fitting.empty()) {
    // Of a type that only claims the meaning, its description is as good.
    if (auto made = MakeBound(type, fitting, options, library)) return made;
  }
  return library.Find(own) == nullptr ? MakeDescribed(type, library) : MakeBound(type, own, options, library);
}

}  // namespace runnel
