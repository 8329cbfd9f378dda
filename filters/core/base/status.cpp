#include "base/status.h"

#include <algorithm>

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
    case StatusCode::cancelled:
      return "cancelled";
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

Status Status::failure(StatusCode code, std::string message)
{
  Status status;
  status.code = code;
  status.message = std::move(message);
  return status;
}

Status Status::invalid_input(std::string message)
{
  return failure(StatusCode::invalid_input, std::move(message));
}

Status Status::cancelled()
{
  return failure(StatusCode::cancelled, "cancelled");
}

} // namespace bindpose
