#pragma once

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace runnel::test {

/// A certificate and its key, made by openssl for one test.
class Certificate {
  const TemporaryFolder folder_;  // tests run at the same time

 public:
  explicit Certificate(const std::string& name)
      : certificate(folder_ / (name + "_certificate.pem")), key(folder_ / (name + "_key.pem")) {
    const std::string command =
        "umask 077; openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 2 "
        "-subj /CN=localhost -keyout '" +
        key + "' -out '" + certificate + "' 2>/dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }
  Certificate(const Certificate&) = delete;
  Certificate& operator=(const Certificate&) = delete;

  const std::string certificate;
  const std::string key;
};

}  // namespace runnel::test
