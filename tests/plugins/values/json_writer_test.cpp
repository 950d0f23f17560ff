#include "plugins/values/json_writer.h"

#include <new>
#include <random>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "plugins/testing/fault_injection.h"
#include "plugins/values/value_bytes.h"

namespace runnel {
namespace {

std::string Quoted(std::string_view text) {
  std::string json;
  AppendJsonString(text, json);
  return json;
}

TEST(JsonWriter, EscapesWhatMustNotStandInATextAsItIs) {
  EXPECT_EQ(Quoted("a\"b\\c\n\r\t\x01\x7f"), R"("a\"b\\c\n\r\t\u0001\u007f")");
  EXPECT_EQ(Quoted("ä€\xf0\x9f\xa4\x96"), "\"ä€\xf0\x9f\xa4\x96\"");
}

TEST(JsonWriter, ReplacesWhatIsNoUtf8) {
  EXPECT_EQ(Quoted("a\x80z"), "\"a\xef\xbf\xbdz\"");
  EXPECT_EQ(Quoted("\xe2\x82"), "\"\xef\xbf\xbd\xef\xbf\xbd\"");
  std::mt19937 random(2);
  for (int i = 0; i < 20000; ++i) {
    std::string text(random() % 12, '\0');
    for (char& character : text) character = static_cast<char>(random());
    ASSERT_TRUE(nlohmann::json::accept(Quoted(text)));
  }
}

TEST(JsonWriter, WritesObjectsWithinObjects) {
  std::string json;
  {
    JsonObject object(json);
    object.Add("name", "a\"b");
    object.Add("is_open", true);
    object.Add("count", std::uint64_t{18446744073709551615U});
    object.Add("offset", -3);
    object.Add("size", 0.5);
    {
      JsonArray list(object.Key("list"));
      list.Add("x");
      JsonObject inner(list.Next());
    }
    object.AddJson("raw", "[1]");
  }
  EXPECT_EQ(json, R"({"name":"a\"b","is_open":true,"count":18446744073709551615,"offset":-3,)"
                  R"("size":0.5,"list":["x",{}],"raw":[1]})");
}

// Objects within objects, so that some allocation is that of a closing bracket.
void WriteNested(std::string& json, int levels) {
  JsonObject object(json);
  if (levels > 0) WriteNested(object.Key(""), levels - 1);
}

TEST(JsonWriter, ThrowsWhereThereIsNoMemoryForABracket) {
  std::string json;
  const auto write = [&] {
    json = std::string();
    try {
      WriteNested(json, 100);
    } catch (const std::bad_alloc&) {
      json = "{}";
    }
  };
  const std::size_t points = test::AtEachPoint(test::InjectedFault::kAllocation, write,
                                               [&](bool has_struck) { EXPECT_EQ(json.size(), has_struck ? 2 : 502); });
  EXPECT_GT(points, 2U);
}

TEST(JsonWriter, WritesBytesAsBase64) {
  const auto encoded = [](std::string_view bytes) {
    std::string text;
    AppendBase64(bytes, text);
    return text;
  };
  // RFC 4648, 10.
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded(std::string("\xff\xfe\x00\xfb", 4)), "//4A+w==");
}

}  // namespace
}  // namespace runnel
