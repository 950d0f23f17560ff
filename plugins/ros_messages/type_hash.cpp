#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "plugins/ros_messages/message_library.h"

namespace runnel {

namespace {

using Words = std::array<std::uint32_t, 64>;
using State = std::array<std::uint32_t, 8>;

// The first bits of the fractions of the cube roots of the first 64 primes.
constexpr Words kRounds = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

void Take(const char* block, State& state) {
  Words words{};
  for (std::size_t i = 0; i < 16; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      words[i] = words[i] << 8 | static_cast<unsigned char>(block[4 * i + j]);
    }
  }
  for (std::size_t i = 16; i < 64; ++i) {
    const std::uint32_t a = words[i - 15], b = words[i - 2];
    words[i] = words[i - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3) + words[i - 7] +
               (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10);
  }
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint32_t first = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                                ((e & f) ^ (~e & g)) + kRounds[i] + words[i];
    const std::uint32_t second = (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) +
                                 ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + first;
    d = c, c = b, b = a, a = first + second;
  }
  const State change = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < state.size(); ++i) state[i] += change[i];
}

// FIPS 180-4, as 64 hexadecimal digits.
std::string Sha256(std::string_view bytes) {
  State state = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  constexpr std::size_t kBlock = 64;
  std::string padded(bytes);
  padded += '\x80';
  while (padded.size() % kBlock != kBlock - 8) padded += '\0';
  const std::uint64_t bits = bytes.size() * 8;
  for (int shift = 56; shift >= 0; shift -= 8) padded += static_cast<char>(bits >> shift & 0xff);
  for (std::size_t i = 0; i < padded.size(); i += kBlock) Take(padded.data() + i, state);
  std::string digits;
  for (const std::uint32_t word : state) {
    for (int shift = 28; shift >= 0; shift -= 4) digits += "0123456789abcdef"[word >> shift & 15];
  }
  return digits;
}

// With the spaces of Python's json.dumps(), since it is this text of which ROS 2 takes the hash.
std::string DescriptionOf(const MessageField& field) {
  constexpr int kArray = 48, kBounded = 96, kList = 144, kToBoundedString = 4;
  int id = static_cast<int>(field.type);
  if (field.text_capacity > 0) id += kToBoundedString;
  if (field.count == MessageCount::kArray) id += kArray;
  if (field.count == MessageCount::kBounded) id += kBounded;
  if (field.count == MessageCount::kList) id += kList;
  return R"({"name": ")" + field.name + R"(", "type": {"type_id": )" + std::to_string(id) +
         R"(, "capacity": )" + std::to_string(field.capacity) + R"(, "string_capacity": )" +
         std::to_string(field.text_capacity) + R"(, "nested_type_name": ")" + field.nested +
         R"("}})";
}

std::string DescriptionOf(const MessageDefinition& definition) {
  std::string text = R"({"type_name": ")" + definition.name + R"(", "fields": [)";
  static const MessageField kInstead{.name = "structure_needs_at_least_one_member",
                                     .type = MessageType::kUint8};
  if (definition.fields.empty()) text += DescriptionOf(kInstead);
  for (const MessageField& field : definition.fields) {
    if (&field != &definition.fields.front()) text += ", ";
    text += DescriptionOf(field);
  }
  return text + "]}";
}

}  // namespace

std::string TypeHashOf(const MessageDefinition& definition, const MessageLibrary& library) {
  std::string text = R"({"type_description": )" + DescriptionOf(definition) +
                     R"(, "referenced_type_descriptions": [)";
  std::string between;
  for (const MessageDefinition* const each : library.InsideOf(definition)) {
    text += between + DescriptionOf(*each);
    between = ", ";
  }
  return "RIHS01_" + Sha256(text + "]}");
}

}  // namespace runnel
