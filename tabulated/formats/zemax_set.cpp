// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/zemax_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>
#include <utility>

#include "brdf/error.hpp"

namespace gonio::tabulated {
namespace {

constexpr std::string_view line_begin = " Channel ", between = " of ", own_name = " = ", other_file = " in ";
/// More channels than this are not one picture of a surface, and no set of ours.
constexpr std::size_t most_files = 4096;

/// The number that `text` begins with, taken off it; 0 if there is none.
std::size_t take_number(std::string_view& text) {
  std::size_t out = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc()) return 0;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return out;
}

bool take(std::string_view& text, std::string_view what) {
  if (!text.starts_with(what)) return false;
  text.remove_prefix(what.size());
  return true;
}

bool suits_a_file_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
}

bool is_of_set(const std::string& comment) { return comment.starts_with(line_begin); }

/// The table under other names, without the comments of sets.
std::shared_ptr<const ZemaxTable> renamed(const ZemaxTable& table, Channels channels) {
  ZemaxRemarks remarks = table.remarks();
  std::erase_if(remarks.comments, is_of_set);
  return std::make_shared<const ZemaxTable>(table.grid(), std::move(channels), table.values(), std::move(remarks));
}

}  // namespace

std::vector<std::filesystem::path> zemax_set_files(const std::filesystem::path& path, const Channels& channels) {
  std::vector<std::filesystem::path> out;
  for (const Channel& channel : channels) {
    std::string name = channel.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !suits_a_file_name(c); }, '_');
    out.push_back(path.parent_path() / (path.stem().string() + "-" + name + path.extension().string()));
    if (std::find(out.begin(), out.end() - 1, out.back()) != out.end() - 1)
      throw Error(ErrorKind::input, {path.string(), fmt::format("two channels whose file would be {}", out.back().filename().string()),
                                     "channels of different names"});
  }
  return out;
}

std::vector<std::string> zemax_set_comments(const ZemaxSetPlace& place) {
  std::vector<std::string> out;
  for (std::size_t k = 1; k <= place.count; ++k)
    out.push_back(fmt::format("{}{}{}{}{}{}", line_begin, k, between, place.count, k == place.number ? own_name : other_file,
                              k == place.number ? place.channel : place.files[k - 1]));
  return out;
}

std::optional<ZemaxSetPlace> zemax_set_place(const std::vector<std::string>& comments) {
  ZemaxSetPlace out;
  std::size_t named = 0;
  for (const std::string& comment : comments) {
    std::string_view text = comment;
    while (text.ends_with('\r') || text.ends_with(' ')) text.remove_suffix(1);
    if (!take(text, line_begin)) continue;
    const std::size_t number = take_number(text);
    if (!take(text, between)) continue;
    const std::size_t count = take_number(text);
    if (out.count == 0 && count >= 2 && count <= most_files) out.count = count, out.files.resize(count);
    if (number == 0 || count != out.count || number > count || number == out.number || !out.files[number - 1].empty()) return std::nullopt;
    if (take(text, own_name)) {
      if (out.number != 0 || text.empty()) return std::nullopt;
      out.number = number, out.channel = text;
    } else if (take(text, other_file)) {
      if (text.empty() || !std::all_of(text.begin(), text.end(), [](char c) { return c != '/' && c != '\\' && c != '\0'; }))
        return std::nullopt;
      out.files[number - 1] = text;
    } else {
      return std::nullopt;
    }
    ++named;
  }
  if (out.number == 0 || named != out.count) return std::nullopt;
  return out;
}

std::shared_ptr<const ZemaxTable> whole_zemax_set(std::shared_ptr<const ZemaxTable> first, const std::filesystem::path& path,
                                                  const ReadOptions& options, std::vector<std::string>& missing) {
  const std::optional<ZemaxSetPlace> place = zemax_set_place(first->remarks().comments);
  if (!place || first->channels().size() != 1) return first;
  const auto file_of = [&](std::size_t k) { return k + 1 == place->number ? path : path.parent_path() / place->files[k]; };
  std::error_code ignored;
  for (std::size_t k = 0; k < place->count; ++k)
    if (!std::filesystem::is_regular_file(file_of(k), ignored)) missing.push_back(place->files[k]);
  const auto named = [](Channel channel, const std::string& name) {
    channel.name = name;
    return channel;
  };
  if (!missing.empty()) return renamed(*first, {named(first->channels().front(), place->channel)});

  Channels channels;
  std::vector<std::vector<double>> values;
  ZemaxRemarks remarks;
  for (std::size_t k = 0; k < place->count; ++k) {
    const auto table = k + 1 == place->number ? first : read_zemax(file_of(k), options);
    const auto at = zemax_set_place(table->remarks().comments);
    if (!at || at->number != k + 1 || at->count != place->count || table->channels().size() != 1)
      throw Error(ErrorKind::input, {file_of(k).string(), "a file of another set, or of none",
                                     fmt::format("channel {} of {}, as {} says", k + 1, place->count, path.filename().string())});
    if (!(table->grid() == first->grid()))
      throw Error(ErrorKind::input, {file_of(k).string(), "other angles, or another kind of scatter", "those of " + path.string()});
    channels.push_back(named(table->channels().front(), at->channel));
    values.push_back(table->values().front());
    remarks.tis.push_back(table->remarks().tis.front());
  }
  remarks.comments = first->remarks().comments;
  std::erase_if(remarks.comments, is_of_set);
  for (std::size_t k = 1; k < channels.size(); ++k)
    for (std::size_t j = 0; j < k; ++j)
      if (channels[j].name == channels[k].name)
        throw Error(ErrorKind::input,
                    {file_of(k).string(), fmt::format("channel {} a second time", channels[k].name), "every channel once"});
  return std::make_shared<const ZemaxTable>(first->grid(), std::move(channels), std::move(values), std::move(remarks));
}

}  // namespace gonio::tabulated
