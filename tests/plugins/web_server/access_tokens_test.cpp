#include "plugins/web_server/access_tokens.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

namespace runnel::test {

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(AccessTokens, HaveRolesOrMayChange) {
  const auto tokens = ParseAccessTokens("open-sesame look:just-look-7\n# who drives\n drive:green-car # new\n");
  ASSERT_TRUE(tokens) << tokens.error().ToString();
  EXPECT_THAT(*tokens,
              ElementsAre(AccessToken{WebRole::kChange, "open-sesame"}, AccessToken{WebRole::kLook, "just-look-7"},
                          AccessToken{WebRole::kDrive, "green-car"}));
}

TEST(AccessTokens, AreLongEnoughAndFitIntoAddresses) {
  EXPECT_TRUE(ParseAccessTokens("12345678"));
  EXPECT_TRUE(ParseAccessTokens("Ab-9._~xyz"));
  for (const std::string& text :
       {std::string("1234567"), std::string("with&sign"), std::string(129, 'x'), std::string("look:"),
        std::string("admin:abcdefghij"), std::string("Look:abcdefghij"), std::string(), std::string("# nothing\n"),
        std::string("look:abcdefghij change:abcdefghij"), std::string("quote\"quote")}) {
    const auto tokens = ParseAccessTokens(text);
    ASSERT_FALSE(tokens) << text;
    EXPECT_NE(tokens.error().hint, "") << text;
    for (const char* secret : {"1234567", "with&sign", "abcdefghij"}) {
      EXPECT_THAT(tokens.error().ToString(), Not(HasSubstr(secret))) << "errors go into logs";
    }
  }
}

TEST(AccessTokens, MadeOnesDiffer) {
  const auto a = MakeToken();
  const auto b = MakeToken();
  ASSERT_TRUE(a);
  ASSERT_TRUE(b);
  EXPECT_EQ(a->size(), 32U);
  EXPECT_NE(*a, *b);
  EXPECT_TRUE(ParseAccessTokens(*a));
}

TEST(AccessTokens, AreComparedWhole) {
  EXPECT_TRUE(AreEqualSecrets("open-sesame", "open-sesame"));
  EXPECT_FALSE(AreEqualSecrets("open-sesame", "open-sesamf"));
  EXPECT_FALSE(AreEqualSecrets("open-sesame", "Open-sesame"));
  EXPECT_FALSE(AreEqualSecrets("open-sesame", "open-sesam"));
  EXPECT_FALSE(AreEqualSecrets("open-sesame", ""));
}

class TokenFile : public ::testing::Test {
 protected:
  void Write(const std::string& text, std::filesystem::perms mode) {
    std::ofstream(file_) << text;
    std::filesystem::permissions(file_, mode);
  }
  void TearDown() override { std::filesystem::remove(file_); }

  const std::filesystem::path file_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("token_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

using std::filesystem::perms;

TEST_F(TokenFile, IsReadIfItsOwnerKeepsItForItself) {
  Write("look:just-look-7\nchange:open-sesame\n", perms::owner_read | perms::owner_write);
  const auto tokens = ReadAccessTokens(file_);
  ASSERT_TRUE(tokens) << tokens.error().ToString();
  EXPECT_THAT(*tokens,
              ElementsAre(AccessToken{WebRole::kLook, "just-look-7"}, AccessToken{WebRole::kChange, "open-sesame"}));
}

TEST_F(TokenFile, ThatEverybodyMayReadIsRefusedWithTheCure) {
  Write("open-sesame", perms::owner_read | perms::others_read);
  const auto tokens = ReadAccessTokens(file_);
  ASSERT_FALSE(tokens);
  EXPECT_THAT(tokens.error().ToString(), HasSubstr(file_.string()));
  EXPECT_THAT(tokens.error().message, HasSubstr("everybody"));
  EXPECT_THAT(tokens.error().hint, HasSubstr("chmod 600"));
}

TEST_F(TokenFile, ThatIsNoneIsNamed) {
  const auto absent = ReadAccessTokens("/no/such/file");
  ASSERT_FALSE(absent);
  EXPECT_THAT(absent.error().ToString(), HasSubstr("/no/such/file"));
  const auto folder = ReadAccessTokens(::testing::TempDir());
  ASSERT_FALSE(folder);
  EXPECT_THAT(folder.error().message, HasSubstr("folder"));
  Write("short", perms::owner_read);
  const auto bad = ReadAccessTokens(file_);
  ASSERT_FALSE(bad);
  EXPECT_THAT(bad.error().ToString(), HasSubstr(file_.string()));
}

}  // namespace

}  // namespace runnel::test
