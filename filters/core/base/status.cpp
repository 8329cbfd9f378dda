// Status codes, reports of measured values, and the cleanup of text for messages.
#include "base/status.h"

#include <algorithm>
#include <string_view>

namespace bindpose
{

const char* to_string(StatusCode code)
{
  switch (code)
  {
    case StatusCode::ok:
      return "ok";
    case StatusCode::not_converged:
      return "not_converged";
    case StatusCode::invalid_input:
      return "invalid_input";
    case StatusCode::canceled:
      return "canceled";
    case StatusCode::unavailable:
      return "unavailable";
    case StatusCode::internal_error:
      break;
  }
  return "internal_error";
}

namespace
{
template <typename Entries>
auto find_entry(Entries& entries, const std::string& key)
{
  return std::find_if(
    entries.begin(), entries.end(), [&](const auto& entry) { return entry.first == key; });
}

/// Return the length in bytes of the UTF-8 character at the beginning of the text, or 0 if there is
/// no valid printable character.
std::size_t character_length(std::string_view text)
{
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80)
  {
    return first >= 0x20 && first != 0x7f ? 1 : 0;
  }
  const std::size_t length = first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  if (first < 0xc2 || first > 0xf4 || text.size() < length)
  {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i)
  {
    if ((byte(i) & 0xc0) != 0x80)
    {
      return 0;
    }
  }
  // Reject an overlong encoding, a surrogate, or a code point above U+10FFFF.
  const unsigned second = byte(1);
  const bool is_invalid = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
    (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
  return is_invalid ? 0 : length;
}
} // namespace

void Report::set(const std::string& key, Value value)
{
  const auto entry = find_entry(this->entries_, key);
  if (entry != this->entries_.end())
  {
    entry->second = std::move(value);
    return;
  }
  this->entries_.emplace_back(key, std::move(value));
}

void Report::add(const std::string& key, double value)
{
  this->set(key, Value(this->number(key, 0.0) + value));
}

void Report::erase(const std::string& key)
{
  const auto entry = find_entry(this->entries_, key);
  if (entry != this->entries_.end())
  {
    this->entries_.erase(entry);
  }
}

void Report::merge(const Report& other)
{
  for (const auto& [key, value] : other.entries_)
  {
    this->set(key, value);
  }
}

const Report::Value* Report::find(const std::string& key) const
{
  const auto entry = find_entry(this->entries_, key);
  return entry == this->entries_.end() ? nullptr : &entry->second;
}

double Report::number(const std::string& key, double fallback) const
{
  const Value* value = this->find(key);
  if (!value)
  {
    return fallback;
  }
  if (const auto* integer = std::get_if<std::int64_t>(value))
  {
    return static_cast<double>(*integer);
  }
  const auto* real = std::get_if<double>(value);
  return real ? *real : fallback;
}

std::string Report::text(const std::string& key, const std::string& fallback) const
{
  const Value* value = this->find(key);
  const auto* text = value ? std::get_if<std::string>(value) : nullptr;
  return text ? *text : fallback;
}

std::string sanitize_line(std::string text)
{
  for (std::size_t i = 0; i < text.size();)
  {
    const std::size_t length = character_length(std::string_view(text).substr(i));
    if (length == 0)
    {
      text[i] = '?';
    }
    i += length == 0 ? 1 : length;
  }
  return text;
}

Status Status::failure(StatusCode code, std::string message)
{
  Status status;
  status.code = code;
  status.message = sanitize_line(std::move(message));
  return status;
}

Status Status::invalid_input(std::string message)
{
  return failure(StatusCode::invalid_input, std::move(message));
}

Status Status::canceled()
{
  return failure(StatusCode::canceled, "canceled");
}

} // namespace bindpose
