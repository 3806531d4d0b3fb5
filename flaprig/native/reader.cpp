#include "reader.hpp"

#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace flaprig {
namespace {

constexpr const char* kBlank = " \t\r\n";

// independent of the process's locale, which strtod is not; "nan" and "inf" are no numbers here
bool parse(const std::string& text, std::vector<double>& values) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double value;
  while (stream >> value) values.push_back(value);
  return stream.eof();
}

std::string shown(double value) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream << value;
  return stream.str();
}

}  // namespace

std::string quoted(std::string text) {
  constexpr size_t kLongest = 60;  // bytes
  if (text.size() > kLongest) {
    size_t end = kLongest;
    // 10xxxxxx goes on with a character begun before it
    while (end > 0 && (text[end] & 0xC0) == 0x80) --end;
    text = text.substr(0, end) + "...";
  }
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return "\"" + text + "\"";
}

bool Reader::has(const char* name) const {
  const auto found = attributes_.find(name);
  return found != attributes_.end() && found->second.find_first_not_of(kBlank) != std::string::npos;
}

void Reader::refuse(const char* name, const std::string& allowed) const {
  const auto found = attributes_.find(name);
  const std::string value = found == attributes_.end() ? "" : found->second;
  throw std::invalid_argument(std::string(name) + " must be " + allowed + ", got " +
                              quoted(value));
}

std::string Reader::text(const char* name, const std::string& fallback) const {
  return has(name) ? attributes_.at(name) : fallback;
}

double Reader::number(const char* name, double fallback, Range r, const char* unit) const {
  if (!has(name)) return fallback;
  std::vector<double> values;
  const bool read = parse(attributes_.at(name), values) && values.size() == 1;
  if (!read || !(values[0] >= r.low && values[0] <= r.high) ||
      (r.open_low && values[0] == r.low)) {
    refuse(name, std::string("one number ") + (r.open_low ? "above " : "from ") + shown(r.low) +
                     (r.open_low ? " and up to " : " to ") + shown(r.high) +
                     (*unit ? std::string(" ") + unit : ""));
  }
  return values[0];
}

int Reader::integer(const char* name, int fallback, int low, int high) const {
  if (!has(name)) return fallback;
  std::vector<double> values;
  const bool read = parse(attributes_.at(name), values) && values.size() == 1;
  if (!read || !(values[0] >= low && values[0] <= high) || values[0] != std::floor(values[0])) {
    refuse(name, "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  }
  return static_cast<int>(values[0]);
}

bool Reader::flag(const char* name, bool fallback) const {
  if (!has(name)) return fallback;
  return choice(name, {"false", "true"}) == 1;
}

std::vector<double> Reader::numbers(const char* name) const {
  std::vector<double> values;
  if (has(name) && !parse(attributes_.at(name), values)) {
    refuse(name, "finite numbers with spaces between them");
  }
  return values;
}

int Reader::choice(const char* name, const std::vector<std::string>& choices) const {
  std::string list;
  for (size_t i = 0; i < choices.size(); ++i) {
    if (text(name, choices[0]) == choices[i]) return static_cast<int>(i);
    list += (i == 0 ? "" : i + 1 < choices.size() ? ", " : " or ") + choices[i];
  }
  refuse(name, list);
}

}  // namespace flaprig
