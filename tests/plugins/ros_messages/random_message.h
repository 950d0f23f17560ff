#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/ros_messages/message_library.h"

namespace runnel::test {

/// Octets of any message, straight from its definition: what a message of others could be.
class RandomMessage {
 public:
  RandomMessage(unsigned seed, const MessageLibrary& library) : random_(seed), library_(library) {}

  std::vector<std::byte> Make(const MessageDefinition& definition) {
    std::vector<std::byte> octets;
    CdrWriter writer(octets);
    Write(definition, writer, 4);
    return octets;
  }

 private:
  std::size_t Below(std::size_t end) { return random_() % end; }

  void Write(const MessageDefinition& definition, CdrWriter& writer, std::size_t longest) {
    if (definition.fields.empty()) writer.Put(std::uint8_t{0});
    for (const MessageField& field : definition.fields) {
      std::size_t count = 1;
      if (field.count == MessageCount::kArray) count = field.capacity;
      if (field.count == MessageCount::kList) count = Below(longest + 1);
      if (field.count == MessageCount::kBounded) count = Below(field.capacity + 1);
      if (field.count == MessageCount::kList || field.count == MessageCount::kBounded) writer.PutCount(count);
      for (std::size_t i = 0; i < count; ++i) WriteOne(field, writer, longest / 2);
    }
  }

  void WriteOne(const MessageField& field, CdrWriter& writer, std::size_t longest) {
    switch (field.type) {
      case MessageType::kNested:
        return Write(**library_.Get(field.nested), writer, longest);
      case MessageType::kString:
        return writer.PutText(std::string(Below(std::min<std::size_t>(field.text_capacity, 8) + 1), 'r'));
      case MessageType::kFloat32:
        return writer.Put(static_cast<float>(random_()) / 7);
      case MessageType::kFloat64:
        return writer.Put(static_cast<double>(random_()) / 7);
      case MessageType::kBool:
        return writer.Put(random_() % 2 == 1);
      default:
        break;
    }
    switch (SizeOf(field.type)) {
      case 1:
        return writer.Put(static_cast<std::uint8_t>(random_()));
      case 2:
        return writer.Put(static_cast<std::uint16_t>(random_()));
      case 4:  // as many nanoseconds as a second can have
        return writer.Put(static_cast<std::uint32_t>(random_() % (field.name == "nanosec" ? 1'000'000'000 : ~0U)));
      default:
        return writer.Put(std::uint64_t{random_()} << 32 | random_());
    }
  }

  std::mt19937 random_;
  const MessageLibrary& library_;
};

}  // namespace runnel::test
