// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/look.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "core/classify/reasons.h"
#include "core/system/text.h"
#include "core/task/error.h"

namespace pellucid::classify {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

// A class that combines more takes longer than anyone waits.
constexpr std::size_t maxCombined = 256;

bool isVisible(const TissueClass &tissue) {
    return tissue.weight > 0.0;
}

const TissueClass *find(const Look &look, const std::string &name) {
    const auto found = std::find_if(look.classes.begin(), look.classes.end(),
                                    [&](const TissueClass &tissue) { return tissue.name == name; });
    return found == look.classes.end() ? nullptr : &*found;
}

// Puts the classes of a look in place of the names that steps give.
class Combination {
public:
    explicit Combination(const Look &look) : m_look(look) {}

    TissueClass of(const TissueClass &tissue) {
        TissueClass combined = tissue;
        for (Step &step : combined.steps)
            if (describe(step.kind).input == StepInput::otherClass)
                step.operand = {"", operandOf(tissue, step.operand)};
        return combined;
    }

private:
    using Shared = std::shared_ptr<const TissueClass>;

    Shared operandOf(const TissueClass &user, const Operand &operand) {
        if (operand.name.empty())
            return alone(of(*operand.own));
        if (const auto known = m_known.find(operand.name); known != m_known.end())
            return known->second;
        const TissueClass *const named = find(m_look, operand.name);
        if (named == nullptr)
            throw Error(ErrorCode::usage, because::classIsMissing(user.name, operand.name));
        if (std::count_if(m_look.classes.begin(), m_look.classes.end(),
                          [&](const auto &tissue) { return tissue.name == operand.name; }) > 1)
            throw Error(ErrorCode::usage,
                        because::severalClassesOfThatName(user.name, operand.name));
        if (!m_underway.insert(operand.name).second)
            throw Error(ErrorCode::usage, because::classCombinesItself(operand.name));
        const Shared made = alone(of(*named));
        m_underway.erase(operand.name);
        m_known[operand.name] = made;
        return made;
    }

    // Name, weight and color do not change its samples.
    static Shared alone(TissueClass tissue) {
        tissue.name = "class";
        tissue.weight = 1.0;
        tissue.color = {};
        return std::make_shared<const TissueClass>(std::move(tissue));
    }

    const Look &m_look;
    std::map<std::string, Shared> m_known;
    std::set<std::string> m_underway;
};

// How many classes a class combines, at most `maxCombined` + 1.
std::size_t combinedCount(const TissueClass &tissue) {
    std::size_t count = 0;
    for (const Step &step : tissue.steps)
        if (step.operand.own && count <= maxCombined)
            count += 1 + combinedCount(*step.operand.own);
    return std::min(count, maxCombined + 1);
}

// Calls `change` for every operand of the class, and those of its own classes. It may replace the
// operand.
template <class F> void forOperands(TissueClass &tissue, const F &change) {
    for (Step &step : tissue.steps) {
        if (step.operand.own) {
            TissueClass own = *step.operand.own;
            forOperands(own, change);
            step.operand.own = std::make_shared<const TissueClass>(std::move(own));
        }
        if (!step.operand.name.empty())
            change(step.operand);
    }
}

// How many classes are nested in a class.
int depthOf(const TissueClass &tissue) {
    int depth = 0;
    for (const Step &step : tissue.steps)
        if (step.operand.own)
            depth = std::max(depth, 1 + depthOf(*step.operand.own));
    return depth;
}

void addSegments(const TissueClass &tissue, std::set<std::string> &segments) {
    if (!tissue.segment.empty())
        segments.insert(tissue.segment);
    for (const Step &step : tissue.steps)
        if (step.operand.own)
            addSegments(*step.operand.own, segments);
}

bool isNamedIn(const TissueClass &tissue, const std::string &name, const Look &look,
               std::set<std::string> &seen) {
    return std::any_of(tissue.steps.begin(), tissue.steps.end(), [&](const Step &step) {
        const Operand &operand = step.operand;
        if (operand.own && isNamedIn(*operand.own, name, look, seen))
            return true;
        if (operand.name.empty())
            return false;
        const TissueClass *const next = find(look, operand.name);
        return operand.name == name || (next != nullptr && seen.insert(operand.name).second &&
                                        isNamedIn(*next, name, look, seen));
    });
}

std::set<std::string> namesBut(const Look &look, std::size_t index) {
    std::set<std::string> names;
    for (std::size_t n = 0; n < look.classes.size(); ++n)
        if (n != index)
            names.insert(look.classes[n].name);
    return names;
}

} // namespace

std::vector<TissueClass> withOperands(const Look &look) {
    Combination combination(look);
    std::vector<TissueClass> classes;
    for (const TissueClass &tissue : look.classes)
        classes.push_back(combination.of(tissue));
    return classes;
}

bool dependsOn(const Look &look, const TissueClass &tissue, const std::string &name) {
    std::set<std::string> seen;
    return isNamedIn(tissue, name, look, seen);
}

std::vector<std::set<std::string>> segmentsOf(const Look &look) {
    std::vector<std::set<std::string>> segments;
    for (const TissueClass &tissue : withOperands(look))
        addSegments(tissue, segments.emplace_back());
    return segments;
}

void removeClass(Look &look, std::size_t index) {
    const TissueClass removed = look.classes[index];
    look.classes.erase(look.classes.begin() + std::ptrdiff_t(index));
    if (find(look, removed.name) != nullptr)
        return; // another one of that name takes its place
    const auto own = std::make_shared<const TissueClass>(removed);
    for (TissueClass &tissue : look.classes)
        forOperands(tissue, [&](Operand &operand) {
            if (operand.name == removed.name)
                operand = {"", own};
        });
}

void replaceClass(Look &look, std::size_t index, TissueClass by) {
    const std::string former = look.classes[index].name;
    std::set<std::string> taken = namesBut(look, index);
    if (by.name != former)
        by.name = system::uniqueName(by.name, taken);
    look.classes[index] = std::move(by);
    const std::string now = look.classes[index].name;
    if (now != former && find(look, former) == nullptr)
        for (TissueClass &tissue : look.classes)
            forOperands(tissue, [&](Operand &operand) {
                if (operand.name == former)
                    operand.name = now;
            });
}

void addClass(Look &look, TissueClass tissue) {
    std::set<std::string> taken = namesBut(look, look.classes.size());
    tissue.name = system::uniqueName(tissue.name, taken);
    look.classes.push_back(std::move(tissue));
}

bool haveRegions(const std::vector<TissueClass> &classes) {
    return std::any_of(classes.begin(), classes.end(),
                       [](const TissueClass &tissue) { return !tissue.isRange(); });
}

std::vector<TissueClass> visibleClasses(const Look &look) {
    std::vector<TissueClass> shown = withOperands(look);
    std::erase_if(shown, [](const TissueClass &tissue) { return !isVisible(tissue); });
    return shown;
}

ColorBasis colorBasisOf(const Look &look) {
    std::vector<ColorBasis::Rgb> colors;
    for (const TissueClass &tissue : look.classes)
        if (isVisible(tissue))
            colors.push_back({tissue.color.red, tissue.color.green, tissue.color.blue});
    // Black classes show nothing.
    const ColorBasis::Rgb black{}, white{1.0, 1.0, 1.0};
    if (std::all_of(colors.begin(), colors.end(), [&](const auto &c) { return c == black; })) {
        const std::vector<ColorBasis::Rgb> amounts(colors.size());
        return {{colors.empty() ? white : black}, amounts};
    }
    return colorBasis(colors);
}

std::size_t channelsOf(const Look &look) {
    return colorBasisOf(look).colors.size();
}

bool isGrey(const Look &look) {
    return std::all_of(look.classes.begin(), look.classes.end(), [](const TissueClass &tissue) {
        return !isVisible(tissue) || tissue.color == Color{};
    });
}

void validate(const Look &look) {
    validate(look.transferFunction);
    if (look.classes.size() > maxClasses)
        throw Error(ErrorCode::usage, because::tooManyClasses(look.classes.size(), maxClasses));
    for (const TissueClass &tissue : look.classes) {
        validate(tissue);
        if (depthOf(tissue) > maxDepth)
            throw Error(ErrorCode::usage, because::ofClass(tissue.name, because::combinesTooDeep));
    }
    for (const TissueClass &tissue : withOperands(look))
        if (combinedCount(tissue) > maxCombined)
            throw Error(ErrorCode::usage,
                        because::combinesTooManyClasses(tissue.name, maxCombined));
}

} // namespace pellucid::classify
