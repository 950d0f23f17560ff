#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace runnel::test {

/// A certificate and its key, made by openssl for one test.
class Certificate {
 public:
  explicit Certificate(const std::string& name)
      : certificate(::testing::TempDir() + name + "_certificate.pem"),
        key(::testing::TempDir() + name + "_key.pem") {
    const std::string command =
        "umask 077; openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 2 "
        "-subj /CN=localhost -keyout '" +
        key + "' -out '" + certificate + "' 2>/dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }
  ~Certificate() {
    std::filesystem::remove(certificate);
    std::filesystem::remove(key);
  }
  Certificate(const Certificate&) = delete;
  Certificate& operator=(const Certificate&) = delete;

  const std::string certificate;
  const std::string key;
};

}  // namespace runnel::test
