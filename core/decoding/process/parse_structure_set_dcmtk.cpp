// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <glm/geometric.hpp>

#include "core/decoding/client/reasons.h"
#include "core/decoding/process/damage.h"
#include "core/decoding/process/dataset.h"
#include "core/decoding/process/parse.h"
#include "core/decoding/process/reasons.h"
#include "core/dicom_text/attributes.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::decoding::process {

using namespace dicom_text;

namespace {

namespace because = task::because;

[[noreturn]] void fail(const task::Reason &reason) {
    throw task::Error(task::ErrorCode::unusable, reason);
}

// Calls f with each item of a sequence.
template <class F> void forEachItem(DcmItem *item, const DcmTagKey &tag, const F &f) {
    DcmSequenceOfItems *sequence = nullptr;
    if (item == nullptr || item->findAndGetSequence(tag, sequence).bad() || sequence == nullptr)
        return;
    for (DcmObject *object = sequence->nextInContainer(nullptr); object != nullptr;
         object = sequence->nextInContainer(object))
        if (auto *const each = dynamic_cast<DcmItem *>(object))
            f(each);
}

std::optional<glm::dvec3> readColor(DcmItem *item) {
    const auto rgb = readNumbers(item, DCM_ROIDisplayColor, 3);
    if (rgb.size() != 3)
        return std::nullopt;
    return glm::clamp(glm::dvec3(rgb[0], rgb[1], rgb[2]) / 255.0, 0.0, 1.0);
}

// The numbers of a text that may be long: DCMTK finds each value by counting from the first.
std::optional<std::vector<double>> coordinatesIn(std::string_view text) {
    std::vector<double> numbers;
    while (!text.empty()) {
        std::string_view item = text.substr(0, text.find('\\'));
        text.remove_prefix(std::min(item.size() + 1, text.size()));
        while (!item.empty() && (item.front() == ' ' || item.front() == '+'))
            item.remove_prefix(1);
        while (!item.empty() && (item.back() == ' ' || item.back() == '\0'))
            item.remove_suffix(1);
        double value = 0.0;
        const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), value);
        if (error != std::errc() || end != item.data() + item.size() ||
            !(std::abs(value) <= farthestMm))
            return std::nullopt;
        numbers.push_back(value);
    }
    return numbers;
}

class StructureReader {
public:
    explicit StructureReader(const LoadedFile &file, std::size_t fileBytes)
        : m_dataset(file.dataset()), m_sets(m_dataset) {
        // `headerOf` drops long values: the contours are read first.
        readStructures();
        forEachItem(&m_dataset, DCM_ROIContourSequence, [&](DcmItem *item) { readContours(item); });
        forEachItem(&m_dataset, DCM_RTROIObservationsSequence, [&](DcmItem *item) {
            if (Structure *const of = find(readInteger(item, DCM_ReferencedROINumber)))
                of->type = readText(item, DCM_RTROIInterpretedType);
        });
        m_result.header.instance = headerOf(file, fileBytes);
        if (m_result.header.instance.frameOfReferenceUid.empty())
            m_result.header.instance.frameOfReferenceUid = m_frameOfReference;
    }

    DecodedStructureSet take() {
        std::vector<Structure> &structures = m_result.header.structures;
        if (std::all_of(structures.begin(), structures.end(),
                        [](const Structure &s) { return s.contourSizes.empty(); }))
            fail(because::hasNoContours);
        // In the order of the structures.
        for (const Structure &structure : structures) {
            const auto &points = m_points[structure.number];
            m_result.points.insert(m_result.points.end(), points.begin(), points.end());
        }
        return std::move(m_result);
    }

private:
    void readStructures() {
        forEachItem(&m_dataset, DCM_StructureSetROISequence, [&](DcmItem *item) {
            Structure structure;
            structure.number = readInteger(item, DCM_ROINumber, -1);
            structure.name = readText(item, DCM_ROIName, &m_sets);
            if (find(structure.number) != nullptr)
                fail(because::structureNumberTwice(structure.number));
            if (m_result.header.structures.size() == maxSegments)
                fail(because::hasTooManySegments(maxSegments));
            if (m_frameOfReference.empty())
                m_frameOfReference = readText(item, DCM_ReferencedFrameOfReferenceUID);
            m_result.header.structures.push_back(std::move(structure));
        });
        if (m_result.header.structures.empty())
            fail(because::hasNoSegments);
    }

    void readContours(DcmItem *item) {
        const int number = readInteger(item, DCM_ReferencedROINumber, -1);
        Structure *const structure = find(number);
        if (structure == nullptr)
            fail(because::contourOfUnknownStructure(number));
        structure->color = readColor(item);
        forEachItem(item, DCM_ContourSequence,
                    [&](DcmItem *contour) { readContour(contour, *structure); });
    }

    void readContour(DcmItem *contour, Structure &structure) {
        const std::string type = readText(contour, DCM_ContourGeometricType);
        if (type != "CLOSED_PLANAR" && type != "CLOSEDPLANAR_XOR") {
            ++structure.ignoredContours;
            return;
        }
        // As stored: DCMTK's other getters take time with the square of the number of values.
        const char *text = nullptr;
        Uint32 length = 0;
        std::optional<std::vector<double>> numbers;
        if (contour->findAndGetString(DCM_ContourData, text, length).good() && text != nullptr)
            numbers = coordinatesIn({text, length});
        if (!numbers || numbers->size() % 3 != 0)
            fail(because::contourIsDamaged(structure.name));
        if (numbers->size() < 9) { // encloses nothing
            ++structure.ignoredContours;
            return;
        }
        m_pointCount += numbers->size() / 3;
        if (m_pointCount > maxContourPoints)
            fail(because::hasTooManyPoints(maxContourPoints));
        structure.contourSizes.push_back(std::uint32_t(numbers->size() / 3));
        auto &points = m_points[structure.number];
        points.insert(points.end(), numbers->begin(), numbers->end());
    }

    Structure *find(int number) {
        std::vector<Structure> &all = m_result.header.structures;
        const auto found = std::find_if(all.begin(), all.end(),
                                        [&](const Structure &s) { return s.number == number; });
        return found == all.end() ? nullptr : &*found;
    }

    DcmDataset &m_dataset;
    CharacterSets m_sets;
    std::string m_frameOfReference;
    std::map<int, std::vector<double>> m_points; ///< by the structure's number
    std::size_t m_pointCount = 0;
    DecodedStructureSet m_result;
};

DecodedStructureSet decoded(std::span<const std::byte> bytes) {
    const LoadedFile file = loadFile(bytes, Extent::everything);
    std::string uid = readText(&file.dataset(), DCM_SOPClassUID);
    if (uid.empty())
        uid = readText(file.format->getMetaInfo(), DCM_MediaStorageSOPClassUID);
    InstanceHeader named;
    named.sopClassUid = uid;
    if (!isStructureSet(named))
        fail(because::isNoSegmentation);
    if (!file.isComplete)
        fail(because::isDamagedBy(file.failure));
    return StructureReader(file, bytes.size()).take();
}

} // namespace

DecodedStructureSet decodeStructureSet(std::span<const std::byte> bytes) {
    return orDamaged([&] { return decoded(bytes); });
}

} // namespace pellucid::decoding::process
