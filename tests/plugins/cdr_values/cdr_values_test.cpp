#include "plugins/cdr_values/cdr_values.h"

#include <atomic>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

#include "core/types/builtin_types.h"
#include "core/types/shared_vector_types.h"
#include "core/types/text_format.h"
#include "core/types/type_of.h"
#include "plugins/testing/guards.h"
#include "tests/plugins/cdr_values/random_value.h"
#include "tests/plugins/values/example_types.h"

namespace example {

/// With lists whose memory may be that of the octets.
struct Large {
  std::string name;
  runnel::SharedVector<std::uint8_t> bytes;
  runnel::SharedVector<double> numbers;
  std::vector<float> own;
};
inline void Describe(runnel::TypeBuilder<Large>& type) {
  type.Name("Large")
      .Field("name", &Large::name)
      .Field("bytes", &Large::bytes)
      .Field("numbers", &Large::numbers)
      .Field("own", &Large::own);
}

/// As sensor_msgs/LaserScan.
struct Scan {
  runnel::Time stamp{};
  std::string frame;
  float from = 0, to = 0;
  std::vector<float> ranges, intensities;
};
inline void Describe(runnel::TypeBuilder<Scan>& type) {
  type.Name("Scan")
      .Field("stamp", &Scan::stamp)
      .Field("frame", &Scan::frame)
      .Field("from", &Scan::from)
      .Field("to", &Scan::to)
      .Field("ranges", &Scan::ranges)
      .Field("intensities", &Scan::intensities);
}

}  // namespace example

namespace runnel::test {
namespace {

using example::Everything;
using example::Point;
using example::Scan;
using example::Side;
using testing::HasSubstr;

using Octets = std::vector<std::byte>;

template <typename T>
Octets CdrOf(const T& value) {
  Octets octets;
  WriteCdr(TypeOf<T>(), &value, octets);
  return octets;
}

std::string Hex(const Octets& octets) {
  std::string text;
  for (const std::byte octet : octets) {
    text += "0123456789abcdef"[std::to_integer<unsigned>(octet) >> 4];
    text += "0123456789abcdef"[std::to_integer<unsigned>(octet) & 15];
  }
  return text;
}

Octets FromHex(std::string_view text) {
  Octets octets;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    octets.push_back(static_cast<std::byte>(std::stoi(std::string(text.substr(i, 2)), nullptr, 16)));
  }
  return octets;
}

template <typename T>
T FromCdr(const Octets& octets) {
  T value{};
  const auto read = ReadCdr(TypeOf<T>(), octets, &value);
  EXPECT_TRUE(read) << (read ? "" : read.error().ToString());
  return value;
}

template <typename T>
std::string WhyNotCdr(const Octets& octets) {
  T value{};
  const auto read = ReadCdr(TypeOf<T>(), octets, &value);
  return read ? "it could be read" : read.error().message;
}

// The octets of others: by hand, Cyclone and Foxglove wrote the same for a scan of this shape.
// clang-format off
TEST(Cdr, IsWhatOthersWrite) {
  const Scan scan{.stamp = Time(Duration(5'000'000'006)),
                  .frame = "laser",
                  .from = -1.5F,
                  .to = 1.5F,
                  .ranges = {1, 2},
                  .intensities = {}};
  EXPECT_EQ(Hex(CdrOf(scan)),
            "00010000" "05000000" "06000000" "06000000" "6c6173657200" "0000" "0000c0bf" "0000c03f"
            "02000000" "0000803f" "00000040" "00000000");
  EXPECT_EQ(Hex(CdrOf(std::string())), "00010000" "01000000" "00");
  EXPECT_EQ(Hex(CdrOf(Signal{})), "00010000" "00");
  EXPECT_EQ(Hex(CdrOf(true)), "00010000" "01");
  EXPECT_EQ(Hex(CdrOf(Side::kRight)), "00010000" "07");
  EXPECT_EQ(Hex(CdrOf(std::vector<double>{})), "00010000" "00000000") << "nothing to align";
  EXPECT_EQ(Hex(CdrOf(std::vector<double>{1})), "00010000" "01000000" "00000000" "000000000000f03f");
  EXPECT_EQ(Hex(CdrOf(std::optional<std::uint16_t>{3})), "00010000" "01000000" "0300");
  EXPECT_EQ(Hex(CdrOf(Duration(-1))), "00010000" "ffffffff" "ffc99a3b");
}

TEST(Cdr, ComesBack) {
  RandomValue random(3);
  for (int i = 0; i < 2000; ++i) {
    Everything value;
    random.Fill(TypeOf<Everything>(), &value, static_cast<std::size_t>(i % 6));
    ASSERT_EQ(JsonOf(FromCdr<Everything>(CdrOf(value))), JsonOf(value));
  }
}

TEST(Cdr, OfBigEndiansIsRead) {
  const auto scan = FromCdr<Scan>(FromHex("00000000" "00000005" "00000006" "00000006" "6c6173657200" "0000"
                                          "bfc00000" "3fc00000" "00000002" "3f800000" "40000000" "00000000"));
  EXPECT_EQ(scan.stamp, Time(Duration(5'000'000'006)));
  EXPECT_EQ(scan.frame, "laser");
  EXPECT_THAT(scan.ranges, testing::ElementsAre(1.0F, 2.0F));
}

TEST(Cdr, MayBePaddedOrLackTheLastFields) {
  EXPECT_EQ(FromCdr<std::string>(FromHex("00010003" "01000000" "00000000")), "");
  EXPECT_EQ(FromCdr<Point>(FromHex("00010000" "0000000000000040")).y, 2.0) << "as the type has it";
  Point used{7, 7};
  ASSERT_TRUE(ReadCdr(TypeOf<Point>(), FromHex("00010000" "0000000000000040"), &used));
  EXPECT_EQ(used, (Point{2, 2})) << "and not what was there before";
  EXPECT_EQ(WhyNotCdr<Point>(FromHex("00010000")), "x: the octets end before it does");
  EXPECT_EQ(WhyNotCdr<std::vector<Point>>(FromHex("00010000" "01000000" "00000000" "0000000000000040")),
            "it claims more elements than there are octets for");
}

TEST(WrongCdr, IsToldWithItsField) {
  EXPECT_EQ(WhyNotCdr<Point>({}), "a value in CDR begins with 4 octets, and here are 0");
  EXPECT_EQ(WhyNotCdr<Point>(FromHex("00070000" "0000000000000040")),
            "the octets are no plain CDR, but of the kind 7");
  EXPECT_EQ(WhyNotCdr<Side>(FromHex("00010000" "05")), "there is no Side of the number 5");
  EXPECT_EQ(WhyNotCdr<std::vector<Side>>(FromHex("00010000" "02000000" "0005")),
            "[1]: there is no Side of the number 5");
  EXPECT_EQ(WhyNotCdr<std::optional<bool>>(FromHex("00010000" "02000000" "0101")),
            "a bool? cannot have 2 elements");
  EXPECT_EQ(WhyNotCdr<std::string>(FromHex("00010000" "ffffffff" "00")),
            "the octets end before it does");
  EXPECT_EQ(WhyNotCdr<Eigen::MatrixXd>(FromHex("00010000" "02000000" "02000000" "00000000")),
            "0 elements are too many or too few");
  EXPECT_EQ(WhyNotCdr<Eigen::MatrixXd>(FromHex("00010000" "0000ffff" "00000000" "00000000")),
            "a matrix double[,] cannot have 0 elements");
  EXPECT_TRUE(FromCdr<bool>(FromHex("00010000" "02"))) << "no octet makes a bool that is neither";

  Everything value;
  Everything* at = &value;
  for (int i = 0; i < 101; ++i) {
    at->branches.resize(1);
    at = &at->branches[0];
  }
  EXPECT_THAT(WhyNotCdr<Everything>(CdrOf(value)), HasSubstr("nested deeper than 100 levels"));
}

// Whatever comes, the reader says yes or no, and takes no more memory than there are octets for; what it takes can be
// written and read again.
TEST(WrongCdr, DoesNoHarm) {
  RandomValue random(7);
  Everything value;
  random.Fill(TypeOf<Everything>(), &value, 6);
  const Octets whole = CdrOf(value);
  int accepted = 0;
  for (int i = 0; i < 30000; ++i) {
    Octets octets = whole;
    for (auto change = 1 + random.Below(3); change > 0; --change) {
      const std::size_t at = random.Below(octets.size());
      switch (random.Below(4)) {
        case 0:
          octets[at] = static_cast<std::byte>(random.Below(256));
          break;
        case 1:
          octets[at] = static_cast<std::byte>(random.Below(2) * 255);
          break;
        case 2:
          octets.resize(at + 1);
          break;
        default:
          octets.insert(octets.begin() + static_cast<std::ptrdiff_t>(at), std::byte{1});
      }
    }
    Everything read;
    if (!ReadCdr(TypeOf<Everything>(), octets, &read)) continue;
    ++accepted;
    ASSERT_EQ(Hex(CdrOf(FromCdr<Everything>(CdrOf(read)))), Hex(CdrOf(read)));
  }
  EXPECT_GT(accepted, 100);
}

// In memory that processes share, whoever writes may change octets while they are read.
// clang-format on
TEST(WrongCdr, DoesNoHarmWhileItChanges) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "what is tried is a race";
#endif
  RandomValue random(9);
  Everything value;
  random.Fill(TypeOf<Everything>(), &value, 6);
  Octets octets = CdrOf(value);
  std::atomic<bool> has_ended{false};
  std::thread changing([&] {
    RandomValue place(10);
    while (!has_ended) {
      volatile std::byte& octet = octets[place.Below(octets.size())];
      const std::byte before = octet;
      octet = static_cast<std::byte>(place.Below(2) * 255);
      std::this_thread::yield();
      octet = before;
    }
  });
  for (int i = 0; i < 5000; ++i) {
    Everything read;
    if (ReadCdr(TypeOf<Everything>(), octets, &read) && i % 100 == 0) {
      EXPECT_FALSE(CdrOf(read).empty());
    }
  }
  has_ended = true;
  changing.join();
}

TEST(Cdr, OfOpaqueTypesIsRefused) {
  struct Secret {};
  TypeInfo secret(typeid(Secret));
  EXPECT_FALSE(CheckCdr(secret));
  EXPECT_TRUE(CheckCdr(TypeOf<Everything>()));
}

TEST(Cdr, LargeListsReferToOctetsThatAreKept) {
  example::Large large{.name = "x",
                       .bytes = SharedVector<std::uint8_t>(5001, 7),
                       .numbers = SharedVector<double>(1000, 8.0),
                       .own = std::vector<float>(2000, 9.0F)};
  // So that what follows the header is aligned.
  const auto kept = std::make_shared<std::vector<double>>(5000);
  const Octets octets = CdrOf(large);
  auto* const begin = reinterpret_cast<std::byte*>(kept->data()) + 4;
  std::ranges::copy(octets, begin);
  const std::span<const std::byte> lying(begin, octets.size());
  const auto is_inside = [&](const auto& list) {
    const auto* const first = reinterpret_cast<const std::byte*>(list.data());
    return first >= begin && first < begin + octets.size();
  };
  const auto is_as_written = [&](const example::Large& read) {
    return read.name == "x" && read.bytes == large.bytes && read.numbers == large.numbers && read.own == large.own;
  };
  const TypeInfo& type = TypeOf<example::Large>();
  example::Large read;
  ASSERT_TRUE(ReadCdr(type, lying, &read, kept));
  EXPECT_TRUE(is_inside(std::as_const(read.bytes)) && is_inside(std::as_const(read.numbers)));
  EXPECT_FALSE(is_inside(read.own));
  EXPECT_TRUE(is_as_written(read));
  EXPECT_EQ(kept.use_count(), 3);
  ASSERT_TRUE(ReadCdr(type, lying, &read)) << "the same value, of octets that go";
  EXPECT_FALSE(read.bytes.is_reference() || read.numbers.is_reference());
  EXPECT_TRUE(is_as_written(read));
  EXPECT_EQ(kept.use_count(), 1);

  std::ranges::copy(octets, begin - 1);  // numbers do not lie where the machine wants them
  ASSERT_TRUE(ReadCdr(type, {begin - 1, octets.size()}, &read, kept));
  EXPECT_TRUE(read.bytes.is_reference());
  EXPECT_FALSE(read.numbers.is_reference());
  EXPECT_TRUE(is_as_written(read));

  // Of another machine's order: bytes are the same, numbers are not.
  std::ranges::copy(FromHex("00000000"
                            "00001388"),
                    begin);
  SharedVector<std::uint8_t> bytes;
  ASSERT_TRUE(ReadCdr(TypeOf<SharedVector<std::uint8_t>>(), {begin, 8 + 5000}, &bytes, kept));
  EXPECT_EQ(bytes.size(), 5000U);
  EXPECT_TRUE(bytes.is_reference());
  SharedVector<float> numbers;
  ASSERT_TRUE(ReadCdr(TypeOf<SharedVector<float>>(), {begin, 8 + 20000}, &numbers, kept));
  EXPECT_EQ(numbers.size(), 5000U);
  EXPECT_FALSE(numbers.is_reference());
  EXPECT_FALSE(ReadCdr(TypeOf<SharedVector<float>>(), {begin, 8 + 19999}, &numbers, kept));
}

TEST(Cdr, OfKnownSizeAllocatesNothing) {
  Scan scan;
  scan.ranges.assign(720, 1.0F);
  scan.frame = "a frame of more than fifteen letters";
  Scan read = scan;
  Octets octets = CdrOf(scan);
  const AllocationGuard guard;
  WriteCdr(TypeOf<Scan>(), &scan, octets);
  const bool is_read = ReadCdr(TypeOf<Scan>(), octets, &read).has_value();
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_TRUE(is_read);
}

}  // namespace
}  // namespace runnel::test
