/// Points come from a table or from lines of G-code; between them everything is straight and even.
#include "input/travel_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "input/column_table.hpp"
#include "input/units.hpp"
#include "numbers/index_casts.hpp"
#include "system/input_file.hpp"

namespace solidus {

namespace {

double length(const Position& a, const Position& b) {
  return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

/// Whether the ending of a file says that it holds G-code.
bool names_gcode(const std::filesystem::path& file) {
  for (const char* ending : {".gcode", ".nc", ".ngc", ".tap"})
    if (file.extension() == ending) return true;
  return false;
}

/// The values of a column in SI; where it is absent and need not be there `otherwise`.
std::vector<double> column(const ColumnTable& table, const std::string& name, const char* unit, bool required,
                           double otherwise, std::size_t rows) {
  const auto found =
      std::ranges::find_if(table.columns, [&](const ColumnTable::Column& c) { return c.name == name; });
  if (found == table.columns.end()) {
    if (required)
      throw InputError({table.file}, fmt::format("a path has no column '{}'", name),
                       "t[s], x[mm], y[mm] and, in space, z[mm]; on, from 0 to 1, where it is switched");
    return std::vector<double>(rows, otherwise);
  }
  // A column without a unit would be a guess, but for shares.
  std::vector<double> values = found->values;
  try {
    const units::Conversion to_si = units::conversion(found->unit.empty() ? "1" : found->unit, unit);
    for (double& value : values) value = to_si(value);
  } catch (const std::invalid_argument& error) {
    throw InputError({table.file}, fmt::format("the column '{}': {}", name, error.what()),
                     fmt::format("'{}[{}]'", name, unit));
  }
  for (std::size_t row = 0; row < values.size(); ++row)
    if (!std::isfinite(values[row]))
      throw InputError(table.place(*found, row), fmt::format("'{}' has no number here", name));
  return values;
}

/// A path from the columns of a table, with the checks that a path needs.
TravelPath path_of_table(const ColumnTable& table, int dimension, double start) {
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.front().values.size();
  const std::vector<double> t = column(table, "t", "s", true, 0, rows),
                            x = column(table, "x", "m", true, 0, rows),
                            y = column(table, "y", "m", true, 0, rows),
                            z = column(table, "z", "m", dimension > 2, 0, rows),
                            on = column(table, "on", "1", false, 1, rows);
  if (rows < 2) throw InputError({table.file}, fmt::format("a path of {} points", rows), "two or more");
  // Times must rise, so that every point is reached once and no speed is infinite.
  std::vector<TravelPoint> points;
  for (std::size_t i = 0; i < rows; ++i) {
    const SourceLocation here = table.place(table.columns.front(), i);
    if (i > 0 && !(t[i] > t[i - 1]))
      throw InputError(here, fmt::format("the time {:g} s follows {:g} s", t[i], t[i - 1]),
                       "times that rise");
    if (on[i] < 0 || on[i] > 1)
      throw InputError(here, fmt::format("'on' is {:g}", on[i]), "a share from 0 to 1");
    points.push_back({t[i] + start, {x[i], y[i], z[i]}, on[i]});
  }
  return TravelPath(std::move(points));
}

/// One word of G-code, a letter with a number.
struct Word {
  char letter = 0;
  double number = 0;
};

/// The words of a line without its comments.
std::vector<Word> words(std::string line, const SourceLocation& where) {
  line = line.substr(0, line.find(';'));
  // Comments are in brackets or follow a semicolon.
  for (std::size_t open; (open = line.find('(')) != std::string::npos;) {
    const std::size_t close = line.find(')', open);
    if (close == std::string::npos) throw InputError(where, "a comment has no end", "( ... )");
    line.erase(open, close - open + 1);
  }
  std::vector<Word> all;
  const char* at = line.c_str();
  while (*at != 0) {
    if (std::isspace(static_cast<unsigned char>(*at)) != 0 || *at == '%') {
      ++at;
      continue;
    }
    const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(*at++)));
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (letter < 'A' || letter > 'Z' || end == at || !std::isfinite(number))
      throw InputError(where, fmt::format("'{}' is no word of G-code", line),
                       "a letter and a number: G1 X12.5 F600");
    all.push_back({letter, number});
    at = end;
  }
  return all;
}

/// The state of a machine that reads G-code line by line.
class Machine {
 public:
  Machine(std::string name, double start) : name_(std::move(name)), time_(start) {}

  void read(const std::string& line, int number) {
    where_ = {name_, number, 0};
    Position target = x_;
    bool moves = false;
    double wait = 0;
    // Codes of a line take effect first, then its coordinates.
    const std::vector<Word> all = words(line, where_);
    for (const Word& word : all)
      if (word.letter == 'G' || word.letter == 'M') code(word);
    for (const Word& word : all) {
      const auto axis = as_size(word.letter - 'X');
      if (word.letter >= 'X' && word.letter <= 'Z') {
        target[axis] = (relative_ ? x_[axis] : 0) + unit_ * word.number;
        moves = true;
      } else if (word.letter == 'F') {
        if (!(word.number > 0))
          throw InputError(where_, fmt::format("the feed is {:g}", word.number),
                           "a feed above zero, per minute");
        feed_ = unit_ * word.number / 60;
      } else if (word.letter == 'P' && dwells_) {
        wait = 1e-3 * word.number;
      } else if (word.letter == 'S' && dwells_) {
        wait = word.number;
      } else if (word.letter != 'G' && word.letter != 'M' && word.letter != 'N') {
        throw InputError(
            where_, fmt::format("the word {}{:g} is not known", word.letter, word.number),
            "G0, G1, G4, G20, G21, G90, G91, M2, M3, M4, M5, M30, X, Y, Z, F, N; after G4 P or S");
      }
    }
    // A dwell keeps the place, and the tool as it is, for its time.
    if (dwells_) {
      if (!(wait > 0)) throw InputError(where_, "G4 waits for no time", "G4 P500, in ms, or G4 S0.5, in s");
      add(x_, wait, on_);
    }
    dwells_ = false;
    if (moves) move(target);
  }
  bool ended() const { return ended_; }
  std::vector<TravelPoint> points() {
    if (points_.empty()) throw InputError({name_}, "the G-code moves nothing", "G0 or G1 with X, Y or Z");
    points_.push_back({time_, x_, 0});
    return std::move(points_);
  }

 private:
  void code(const Word& word) {
    // Codes are whole numbers: G2.1 is another one than G2.
    const int number = static_cast<int>(std::lround(word.number));
    if (std::abs(word.number - number) > 1e-9) refuse(word);
    // M codes switch the tool, or end the path.
    if (word.letter == 'M') {
      if (number == 3 || number == 4)
        on_ = 1;
      else if (number == 5)
        on_ = 0;
      else if (number == 2 || number == 30)
        ended_ = true;
      else
        refuse(word);
      return;
    }
    // G codes choose how the words of this line and of those that follow are meant.
    switch (number) {
      case 0:
      case 1:
        rapid_ = number == 0;
        break;
      case 4:
        dwells_ = true;
        break;
      case 20:
      case 21:
        unit_ = number == 20 ? 0.0254 : 1e-3;
        break;
      case 90:
      case 91:
        relative_ = number == 91;
        break;
      default:
        refuse(word);
    }
  }
  [[noreturn]] void refuse(const Word& word) const {
    throw InputError(where_, fmt::format("{}{:g} is not known", word.letter, word.number),
                     "G0, G1, G4, G20, G21, G90, G91, M2, M3, M4, M5, M30");
  }
  void move(const Position& target) {
    // The first place is where the path begins: nothing says from where the tool came.
    const double way = length(x_, target);
    if (!placed_) {
      placed_ = true;
      x_ = target;
      return;
    }
    if (way == 0) return;
    if (!(feed_ > 0)) throw InputError(where_, "a move before any feed is given", "F with a feed per minute");
    add(target, way / feed_, rapid_ ? 0 : on_);
  }
  void add(const Position& target, double duration, double on) {
    points_.push_back({time_, x_, on});
    time_ += duration;
    x_ = target;
  }

  std::string name_;
  SourceLocation where_;
  double time_ = 0, unit_ = 1e-3, feed_ = 0, on_ = 0;
  Position x_{};
  bool relative_ = false, rapid_ = false, dwells_ = false, ended_ = false, placed_ = false;
  std::vector<TravelPoint> points_;
};

}  // namespace

TravelPath::TravelPath(std::vector<TravelPoint> points) : points_(std::move(points)) {
  if (points_.size() < 2) throw std::invalid_argument("a path has two points at least");
  // Each move has a direction; where nothing moves that of the move before holds.
  Position last{};
  std::size_t first = points_.size();
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    if (!(points_[i + 1].time > points_[i].time)) throw std::invalid_argument("the times of a path rise");
    const double way = length(points_[i].x, points_[i + 1].x);
    if (way > 0) {
      for (std::size_t k = 0; k < 3; ++k) last[k] = (points_[i + 1].x[k] - points_[i].x[k]) / way;
      first = std::min(first, i);
    }
    headings_.push_back(last);
  }
  for (std::size_t i = 0; i < first && first < headings_.size(); ++i) headings_[i] = headings_[first];
}

std::size_t TravelPath::segment(double time) const {
  const auto after = std::upper_bound(points_.begin(), points_.end(), time,
                                      [](double t, const TravelPoint& p) { return t < p.time; });
  const auto i = as_size(std::max<std::ptrdiff_t>(after - points_.begin() - 1, 0));
  return std::min(i, headings_.size() - 1);
}

Position TravelPath::at(double time) const {
  const std::size_t i = segment(time);
  const TravelPoint &a = points_[i], &b = points_[i + 1];
  const double s = std::clamp((time - a.time) / (b.time - a.time), 0.0, 1.0);
  Position x{};
  for (std::size_t k = 0; k < 3; ++k) x[k] = a.x[k] + s * (b.x[k] - a.x[k]);
  return x;
}

double TravelPath::on(double time) const {
  if (time < begin() || time >= end()) return 0;
  return points_[segment(time)].on;
}

Position TravelPath::heading(double time) const {
  return headings_[segment(time)];
}

double TravelPath::fastest(double from, double to) const {
  double fastest = 0;
  for (std::size_t i = segment(from); i < headings_.size() && points_[i].time < to; ++i) {
    const TravelPoint &a = points_[i], &b = points_[i + 1];
    if (a.on > 0 && b.time > from) fastest = std::max(fastest, length(a.x, b.x) / (b.time - a.time));
  }
  return fastest;
}

void TravelPath::add_bends(double from, double to, std::vector<double>& times) const {
  const auto first = std::upper_bound(points_.begin(), points_.end(), from,
                                      [](double t, const TravelPoint& p) { return t < p.time; });
  for (auto p = first; p != points_.end() && p->time < to; ++p) times.push_back(p->time);
}

std::vector<double> TravelPath::switches() const {
  std::vector<double> times;
  double before = 0;
  for (std::size_t i = 0; i < headings_.size(); ++i) {
    if (points_[i].on != before) times.push_back(points_[i].time);
    before = points_[i].on;
  }
  if (before > 0) times.push_back(end());
  return times;
}

TravelPath parse_gcode(const std::string& text, const std::string& name, double start) {
  Machine machine(name, start);
  int number = 0;
  for (std::size_t from = 0; from < text.size() && !machine.ended();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    machine.read(text.substr(from, end - from), ++number);
    from = end + 1;
  }
  std::vector<TravelPoint> points = machine.points();
  return TravelPath(std::move(points));
}

TravelPath read_travel_path(const std::filesystem::path& file, int dimension, double start,
                            const SourceLocation& where) {
  require_readable(file, where);
  if (names_gcode(file)) return parse_gcode(read_text_file(file, where), file.string(), start);
  return path_of_table(read_column_table(file), dimension, start);
}

}  // namespace solidus
