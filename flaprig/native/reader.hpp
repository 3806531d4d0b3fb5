// Reads text attributes into numbers, each refusal one sentence: name, value, what is allowed.
#pragma once

#include <string>
#include <vector>

#include "settings.hpp"

namespace flaprig {

struct Range {
  double low, high;
  bool open_low = false;  // low itself is not allowed
};

// text between quotation marks, short, on one line and still UTF-8 after the cut
std::string quoted(std::string text);

class Reader {
 public:
  explicit Reader(const Attributes& attributes) : attributes_(attributes) {}

  // an empty value counts as absent: MuJoCo passes every attribute, "" where none was given
  bool has(const char* name) const;
  std::string text(const char* name, const std::string& fallback) const;
  double number(const char* name, double fallback, Range range, const char* unit) const;
  int integer(const char* name, int fallback, int low, int high) const;
  bool flag(const char* name, bool fallback) const;
  std::vector<double> numbers(const char* name) const;
  // index of the value among the choices
  int choice(const char* name, const std::vector<std::string>& choices) const;
  [[noreturn]] void refuse(const char* name, const std::string& allowed) const;

 private:
  const Attributes& attributes_;
};

}  // namespace flaprig
