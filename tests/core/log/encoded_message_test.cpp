#include "core/log/internal/encoded_message.h"

#include <limits>

#include <gtest/gtest.h>

namespace runnel::test {
namespace {

using internal::EncodedMessage;

template <typename... Arguments>
std::string TextOf(std::string_view format, const Arguments&... arguments) {
  EncodedMessage message(format);
  (message.Add(arguments), ...);
  const std::byte* const bytes = message.Finish();
  EncodedMessage::Header header;
  std::memcpy(&header, bytes, sizeof header);
  return EncodedMessage::TextOf(header, bytes + sizeof header);
}

TEST(EncodedMessageTest, CarriesEachKindOfArgument) {
  EXPECT_EQ(TextOf("{} {} {} {}", true, 'x', -3, 4u), "true x -3 4");
  EXPECT_EQ(TextOf("{} {}", 0.1f, 0.1), "0.1 0.1");
  EXPECT_EQ(TextOf("{:.2f} {:>5} {:#x}", 3.14159, 7, std::uint8_t{255}), "3.14     7 0xff");
  EXPECT_EQ(TextOf("{}", std::numeric_limits<std::uint64_t>::max()), "18446744073709551615");
  EXPECT_EQ(TextOf("{}", std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
  const std::string text = "abc";
  EXPECT_EQ(TextOf("{} {} {:>4}", "literal", text, std::string_view(text)), "literal abc  abc");
  EXPECT_EQ(TextOf("{{}} stays"), "{} stays");
}

TEST(EncodedMessageTest, KeepsTheBeginningOfATextThatIsTooLong) {
  const std::string text = TextOf("<{}>", std::string(10'000, 'x'));
  EXPECT_LT(text.size(), EncodedMessage::kMostBytes);
  EXPECT_TRUE(text.starts_with("<xxx"));
  EXPECT_TRUE(text.ends_with("xxx>"));
}

TEST(EncodedMessageTest, SaysAFormatThatIsTooLongAsItIsWritten) {
  const std::string format(EncodedMessage::kLongestFormat + 1, 'y');
  EXPECT_EQ(TextOf(format, 1), std::string(EncodedMessage::kLongestFormat, 'y').append(" …"));
}

TEST(EncodedMessageTest, SaysTheFormatIfAnArgumentHasNoRoom) {
  const std::string text = TextOf("{} {}", std::string(10'000, 'x'), 7);
  EXPECT_EQ(text, "{} {} …");
}

// A width that is an argument can be seen to be none only when it is formatted.
TEST(EncodedMessageTest, SaysTheFormatIfItDoesNotFit) { EXPECT_EQ(TextOf("{:{}}", 1, -5), "{:{}}"); }

}  // namespace
}  // namespace runnel::test
