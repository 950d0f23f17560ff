#include "plugins/mcap/checksum.h"

#include <array>
#include <cstddef>

namespace runnel {

namespace {

using Table = std::array<std::uint32_t, 256>;

// Tables for eight bytes at a time ("slicing by 8", M. Kounavis and F. Berry, 2005).
constexpr std::array<Table, 8> MakeTables() {
  std::array<Table, 8> tables{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t rest = i;
    for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1) ^ ((rest & 1) != 0 ? 0xEDB88320u : 0);
    tables[0][i] = rest;
  }
  for (std::size_t k = 1; k < tables.size(); ++k) {
    for (std::size_t i = 0; i < 256; ++i) {
      const std::uint32_t before = tables[k - 1][i];
      tables[k][i] = (before >> 8) ^ tables[0][before & 0xFF];
    }
  }
  return tables;
}
constexpr std::array<Table, 8> kTables = MakeTables();

std::uint32_t Byte(std::string_view bytes, std::size_t i) noexcept {
  return static_cast<unsigned char>(bytes[i]);
}

}  // namespace

void Checksum::Add(std::string_view bytes) noexcept {
  std::uint32_t state = state_;
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
    state ^= Byte(bytes, 0) | Byte(bytes, 1) << 8 | Byte(bytes, 2) << 16 | Byte(bytes, 3) << 24;
    state = kTables[7][state & 0xFF] ^ kTables[6][state >> 8 & 0xFF] ^
            kTables[5][state >> 16 & 0xFF] ^ kTables[4][state >> 24] ^ kTables[3][Byte(bytes, 4)] ^
            kTables[2][Byte(bytes, 5)] ^ kTables[1][Byte(bytes, 6)] ^ kTables[0][Byte(bytes, 7)];
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    state = (state >> 8) ^ kTables[0][(state ^ Byte(bytes, i)) & 0xFF];
  }
  state_ = state;
}

}  // namespace runnel
