// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/step.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/classify/look_json.h"
#include "core/task/error.h"

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
                                                          {StepKind::body, "body"},
                                                          {StepKind::skin, "skin"}};

std::string reasonOf(const std::string &text) {
    try {
        classify::stepFromText(text);
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
        classify::validate(Step{kind, {}});
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
    for (const Step &step : look.classes.front().steps)
        EXPECT_EQ(classify::stepFromText(classify::stepText(step)), step);
    const std::string json = classify::toJson(look);
    EXPECT_NE(json.find(R"("steps":[{"kind":"median","radius_mm":1.5},{"kind":"largest"},)"
                        R"({"high":80.0,"itk":1.0,"kind":"edges"}])"),
              std::string::npos)
        << json;
    EXPECT_EQ(classify::lookFromJson(json), look);
    // Default values are not written.
    EXPECT_EQ(classify::stepText({StepKind::edges, {{"low", 20.0}}}), "edges");
}

TEST(Step, InvalidStepsAreRefusedWithTheReason) {
    EXPECT_EQ(reasonOf("median( radius_mm=2)"),
              "the step 'median' has no parameter ' radius_mm'; it has radius_mm");
    EXPECT_EQ(reasonOf("edges("), "the step 'edges(' has no closing bracket");
    for (const char *item : {"low", "low=", "low=x", "low=1,5", "low= 1", "low=1e999", "low=0x1"}) {
        const std::string text = "edges(" + std::string(item) + ")";
        EXPECT_NE(reasonOf(text).find("in the step '" + text + "' is not NAME=NUMBER"),
                  std::string::npos)
            << reasonOf(text);
    }
    // Infinity is a number outside every range.
    EXPECT_EQ(reasonOf("gaussian(sigma_mm=inf)"),
              "sigma_mm of the step 'gaussian' is inf, not between 0.1 and 20");
    EXPECT_EQ(reasonOf("gaussian(sigma_mm=nan)"),
              "sigma_mm of the step 'gaussian' is nan, not between 0.1 and 20");
    EXPECT_EQ(reasonOf("diffusion(iterations=2.5)"),
              "iterations of the step 'diffusion' is 2.5, not a whole number");
    EXPECT_EQ(reasonOf("blur"),
              "unknown step 'blur': use one of gaussian, median, diffusion, gradient, "
              "negate, threshold, edges, binarise, opening, closing, largest, body, skin");
}

} // namespace
} // namespace pellucid
