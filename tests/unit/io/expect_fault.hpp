#pragma once
#include <gtest/gtest.h>
#include <string>

#include "base/fault.hpp"

namespace livebed {

/// The action must throw a Fault with exit code 5 whose text contains every one of the words.
template <class Action>
void expect_io_fault(Action&& action, std::initializer_list<std::string> words) {
  try {
    action();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const base::Fault& fault) {
    EXPECT_EQ(fault.code(), base::Exit::input_output) << fault.what();
    for (const std::string& word : words)
      EXPECT_NE(std::string(fault.what()).find(word), std::string::npos)
          << '"' << word << "\" is not in: " << fault.what();
  }
}

}  // namespace livebed
