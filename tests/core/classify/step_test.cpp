// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/step.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/task/error.h"
#include "tests/support/json_text.h"

namespace pellucid {
namespace {

using classify::Step;
using classify::StepEffect;
using classify::StepKind;

// Files of earlier programs contain these names.
const std::vector<std::pair<StepKind, std::string>> names{{StepKind::gaussian, "gaussian"},
                                                          {StepKind::median, "median"},
                                                          {StepKind::diffusion, "diffusion"},
                                                          {StepKind::gradient, "gradient"},
                                                          {StepKind::negate, "negate"},
                                                          {StepKind::threshold, "threshold"},
                                                          {StepKind::edges, "edges"},
                                                          {StepKind::binarise, "binarise"},
                                                          {StepKind::opening, "opening"},
                                                          {StepKind::closing, "closing"},
                                                          {StepKind::largestComponent, "largest"},
                                                          {StepKind::connected, "connected"},
                                                          {StepKind::grow, "grow"},
                                                          {StepKind::shrink, "shrink"},
                                                          {StepKind::fill, "fill"},
                                                          {StepKind::body, "body"},
                                                          {StepKind::skin, "skin"},
                                                          {StepKind::intersection, "and"},
                                                          {StepKind::join, "or"},
                                                          {StepKind::difference, "without"},
                                                          {StepKind::paint, "paint"},
                                                          {StepKind::scissors, "scissors"}};

std::string reasonOf(const std::string &step) {
    try {
        test::readJson<classify::Look>(R"({"classes":[{"name":"c","range":[0,1],"steps":[)" + step +
                                       "]}]}");
        return "accepted";
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::usage);
        return error.reason().english();
    }
}

TEST(Step, EveryKindHasItsNameInFilesAndADescription) {
    ASSERT_EQ(classify::stepDescriptions().size(), names.size());
    for (std::size_t n = 0; n < names.size(); ++n) {
        const auto &[kind, name] = names[n];
        const auto &description = classify::describe(kind);
        EXPECT_EQ(&description, &classify::stepDescriptions()[n]) << name;
        EXPECT_EQ(description.name, name);
        EXPECT_EQ(classify::stepKindNamed(name), kind);
        EXPECT_EQ(description.effect,
                  kind < StepKind::threshold ? StepEffect::values : StepEffect::region)
            << name;
        EXPECT_FALSE(description.text.empty()) << name;
        Step step{kind};
        if (description.input == classify::StepInput::otherClass)
            step.operand.name = "other";
        classify::validate(step);
        for (const auto &p : description.parameters) {
            EXPECT_EQ((Step{kind, {}}.at(p.name)), p.defaultValue) << name << " " << p.name;
            EXPECT_TRUE(p.minimum <= p.defaultValue && p.defaultValue <= p.maximum) << p.name;
        }
    }
}

TEST(Step, GoesThroughTextAndJson) {
    classify::Look look{{}, {{"all", 0.0, 1.0}}};
    look.classes.front().steps = {{StepKind::median, {{"radius_mm", 1.5}}},
                                  {StepKind::largestComponent, {}},
                                  {StepKind::edges, {{"high", 80.0}, {"itk", 1.0}}}};
    EXPECT_EQ(classify::stepText(look.classes.front().steps[0]), "median(radius_mm=1.5)");
    EXPECT_EQ(classify::stepText(look.classes.front().steps[2]), "edges(high=80,itk=1)");
    const std::string json = test::jsonText(look);
    EXPECT_NE(json.find(R"("steps":[{"kind":"median","radius_mm":1.5},{"kind":"largest"},)"
                        R"({"high":80.0,"itk":1.0,"kind":"edges"}])"),
              std::string::npos)
        << json;
    EXPECT_EQ(test::readJson<classify::Look>(json), look);
    // Default values are not written.
    EXPECT_EQ(classify::stepText({StepKind::edges, {{"low", 20.0}}}), "edges");
}

TEST(Step, InvalidStepsAreRefusedWithTheReason) {
    const std::string at = "/classes/0/steps/0: ";
    EXPECT_EQ(reasonOf(R"({"kind":"median"," radius_mm":2})"),
              at + "the step 'median' has no parameter ' radius_mm'; it has radius_mm");
    EXPECT_EQ(reasonOf(R"({"kind":"gaussian","sigma_mm":1e9})"),
              at + "sigma_mm of the step 'gaussian' is 1e+09, not between 0.1 and 20");
    EXPECT_EQ(reasonOf(R"({"kind":"diffusion","iterations":2.5})"),
              at + "iterations of the step 'diffusion' is 2.5, not a whole number");
    EXPECT_EQ(reasonOf(R"({"kind":"blur"})"),
              "/classes/0/steps/0: unknown step 'blur': use one of gaussian, median, "
              "diffusion, gradient, negate, threshold, edges, binarise, opening, closing, largest, "
              "connected, grow, shrink, fill, body, skin, and, or, without, paint, scissors");
}

} // namespace
} // namespace pellucid
