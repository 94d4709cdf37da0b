#include "isolod/arguments.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "isolod/failure.h"

namespace tool {

namespace {

/// The whole of `text` as a finite number, or a usage failure.
double parse_number(const std::string& option, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || end != text.c_str() + text.size() || !std::isfinite(value)) {
    fail_usage("option " + option + ": '" + text + "' is not a number");
  }
  return value;
}

std::uint64_t parse_count(const std::string& option, const std::string& text, std::uint64_t most) {
  std::uint64_t value = 0;
  bool good = !text.empty();
  for (const char c : text) {
    if (c < '0' || c > '9') {
      good = false;
      break;
    }
    const std::uint64_t digit = static_cast<std::uint64_t>(c - '0');
    if (value > (most - std::min(most, digit)) / 10) fail_usage("option " + option + ": " + text + " is too large");
    value = value * 10 + digit;
  }
  if (!good) fail_usage("option " + option + ": '" + text + "' is not a whole number");
  return value;
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t corner = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = corner + (a[i - 1] == b[j - 1] ? 0 : 1);
      corner = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearest_name(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = 3;
  for (const std::string& name : known) {
    const std::size_t distance = edit_distance(word, name);
    if (distance < best_distance) {
      best_distance = distance;
      best = name;
    }
  }
  return best;
}

Arguments::Arguments(const CommandRule& rule, int count, const char* const* words) : rule_(rule) {
  bool options_over = false;
  for (int i = 0; i < count; ++i) {
    const std::string word = words[i];
    if (!options_over && word == "--") {
      options_over = true;
    } else if (!options_over && word.size() > 1 && word[0] == '-') {
      if (word == "--help" || word == "-h") {
        wants_help_ = true;
        return;
      }
      take_option(word, count, words, i);
    } else {
      operands_.push_back(word);
    }
  }
  if (operands_.size() > rule.operand_count) {
    fail_usage(std::string(rule.name) + ": unexpected word '" + operands_[rule.operand_count] + "'");
  }
  if (operands_.size() < rule.operand_count) {
    fail_usage(std::string(rule.name) + ": wants " + rule.operands + "; --help tells more");
  }
}

void Arguments::take_option(const std::string& word, int count, const char* const* words, int& index) {
  const std::size_t equals = word.compare(0, 2, "--") == 0 ? word.find('=') : std::string::npos;
  const std::string name = word.substr(0, equals);
  const OptionRule& option = rule_of(name);
  if (values_.count(name) != 0) fail_usage("option " + name + " is given twice");
  if (option.value == nullptr) {
    if (equals != std::string::npos) fail_usage("option " + name + " takes no value");
    values_[name] = "";
  } else if (equals != std::string::npos) {
    values_[name] = word.substr(equals + 1);
  } else {
    if (index + 1 >= count || std::string(words[index + 1]).compare(0, 2, "--") == 0) {
      fail_usage("option " + name + " needs a value: " + name + " " + option.value);
    }
    values_[name] = words[++index];
  }
}

const OptionRule& Arguments::rule_of(const std::string& option) const {
  std::vector<std::string> known;
  for (const OptionRule& candidate : rule_.options) {
    if (option == candidate.name) return candidate;
    known.emplace_back(candidate.name);
  }
  const std::string near = nearest_name(option, known);
  fail_usage(std::string(rule_.name) + ": unknown option " + option + (near.empty() ? "" : "; is " + near + " meant?"));
}

std::string Arguments::text(const std::string& option, const std::string& otherwise) const {
  const auto found = values_.find(option);
  return found != values_.end() ? found->second : otherwise;
}

std::string Arguments::required_text(const std::string& option) const {
  if (!has(option)) {
    const OptionRule& wanted = rule_of(option);
    fail_usage(std::string(rule_.name) + ": " + option + " " + wanted.value + " is missing");
  }
  std::string value = text(option, "");
  if (value.empty()) fail_usage("option " + option + " has an empty value");
  return value;
}

double Arguments::number(const std::string& option, double otherwise, double least, double most) const {
  if (!has(option)) return otherwise;
  const std::string word = text(option, "");
  const double value = parse_number(option, word);
  if (value < least || value > most) {
    char range[64];
    std::snprintf(range, sizeof range, "%g to %g", least, most);
    fail_usage("option " + option + ": " + word + " is not in " + range);
  }
  return value;
}

std::uint64_t Arguments::count(const std::string& option, std::uint64_t otherwise, std::uint64_t most) const {
  return has(option) ? parse_count(option, text(option, ""), most) : otherwise;
}

std::uint64_t Arguments::required_count(const std::string& option, std::uint64_t most) const {
  return parse_count(option, required_text(option), most);
}

std::vector<std::uint64_t> Arguments::required_counts(const std::string& option, std::uint64_t most) const {
  const std::string words = required_text(option);
  std::vector<std::uint64_t> counts;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = words.find(',', begin);
    counts.push_back(parse_count(option, words.substr(begin, end - begin), most));
  }
  return counts;
}

std::size_t Arguments::bytes(const std::string& option, std::size_t otherwise) const {
  if (!has(option)) return otherwise;
  std::string word = text(option, "");
  double unit = 1;
  const std::string units = "KMG";
  const std::size_t suffix = word.find_first_of("kKmMgG");
  if (suffix != std::string::npos) {
    const std::string name = word.substr(suffix);
    const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    if (name.size() == 1 || name.substr(1) == "B" || name.substr(1) == "iB") {
      unit = std::pow(1024.0, static_cast<double>(units.find(letter) + 1));
      word.resize(suffix);
    }
  }
  const double value = parse_number(option, word) * unit;
  if (value < 1 || value > 9e15) fail_usage("option " + option + ": " + text(option, "") + " is no possible size");
  return static_cast<std::size_t>(value);
}

std::size_t Arguments::choice(const std::string& option, const std::vector<std::string>& names,
                              std::size_t otherwise) const {
  if (!has(option)) return otherwise;
  const std::string word = text(option, "");
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == word) return i;
    all += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  }
  fail_usage("option " + option + ": '" + word + "' is none of " + all);
}

std::string help_text(const CommandRule& rule, const std::string& program) {
  std::string text = program + " " + rule.operands;
  for (const OptionRule& option : rule.options) {
    if (std::string(option.name) == "--vertices" || std::string(option.name) == "-o") {
      text += std::string(" ") + option.name + " " + option.value;
    }
  }
  text += std::string(rule.options.empty() ? "" : " [options]") + "\n\n" + rule.summary + "\n\n";
  for (const OptionRule& option : rule.options) {
    char line[240];
    const std::string name =
        std::string(option.name) + (option.value != nullptr ? std::string(" ") + option.value : "");
    std::snprintf(line, sizeof line, "  %-32s %s\n", name.c_str(), option.help);
    text += line;
  }
  return text + "  --help                           this text\n";
}

}  // namespace tool
