// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "core/decoding/process/damage.h"
#include "core/decoding/process/dataset.h"
#include "core/decoding/process/frame_headers.h"
#include "core/decoding/process/mend_numbers.h"
#include "core/decoding/process/mosaic.h"
#include "core/decoding/process/parse.h"
#include "core/decoding/process/reasons.h"
#include "core/dicom_text/attributes.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::decoding::process {

using namespace dicom_text;

namespace {

using task::Error;
using task::ErrorCode;

// The longest value of any attribute that is read: a table of 65536 entries.
constexpr Uint32 longestValue = 2 * 65536;

// Compressed pixels have no known size.
std::uint32_t pixelBytes(DcmDataset &dataset) {
    DcmElement *element = nullptr;
    if (dataset.findAndGetElement(DCM_PixelData, element).bad())
        return 0;
    const Uint32 bytes = element->getLengthField();
    return bytes == DCM_UndefinedLength ? 0 : bytes;
}

void readModalityTable(DcmItem &dataset, InstanceHeader &header) {
    DcmItem *item = sequenceItem(&dataset, DCM_ModalityLUTSequence);
    if (item == nullptr)
        return;
    const auto descriptor = readNumbers(item, DCM_LUTDescriptor, 3);
    const Uint16 *data = nullptr;
    unsigned long count = 0;
    if (descriptor.size() != 3 || !(descriptor[0] >= 0.0 && descriptor[0] <= 65536.0) ||
        !(std::abs(descriptor[1]) <= 65536.0) ||
        item->findAndGetUint16Array(DCM_LUTData, data, &count).bad() || data == nullptr)
        return;
    // The descriptor's first value 0 means 65536 entries; the second has the signedness of the
    // pixels.
    const std::size_t entries = descriptor[0] == 0.0 ? 65536 : std::size_t(descriptor[0]);
    header.modalityTable.assign(data, data + std::min<std::size_t>(entries, count));
    header.modalityTableFirst = int(descriptor[1]);
    if (header.isSigned() && header.modalityTableFirst > 32767)
        header.modalityTableFirst -= 65536;
}

// Patient, study and series.
void readIdentity(DcmDataset &dataset, const CharacterSets &sets, InstanceHeader &h) {
    h.sopClassUid = readText(&dataset, DCM_SOPClassUID);
    h.sopInstanceUid = readText(&dataset, DCM_SOPInstanceUID);
    const char *const name = dcmFindNameOfUID(h.sopClassUid.c_str());
    h.sopClassName = name != nullptr ? name : h.sopClassUid;
    h.patientId = readText(&dataset, DCM_PatientID, &sets);
    h.patientName = readText(&dataset, DCM_PatientName, &sets);
    h.birthDate = readText(&dataset, DCM_PatientBirthDate);
    h.sex = readText(&dataset, DCM_PatientSex);
    h.studyUid = readText(&dataset, DCM_StudyInstanceUID);
    h.studyDate = readText(&dataset, DCM_StudyDate);
    h.frameOfReferenceUid = readText(&dataset, DCM_FrameOfReferenceUID);
    h.studyDescription = readText(&dataset, DCM_StudyDescription, &sets);
    h.seriesUid = readText(&dataset, DCM_SeriesInstanceUID);
    h.seriesDescription = readText(&dataset, DCM_SeriesDescription, &sets);
    h.modality = readText(&dataset, DCM_Modality);
    h.bodyPart = readText(&dataset, DCM_BodyPartExamined);
    h.seriesNumber = readInteger(&dataset, DCM_SeriesNumber);
    h.instanceNumber = readInteger(&dataset, DCM_InstanceNumber);
}

// The storage of the pixels, and the meaning of their values.
void readPixelDescription(DcmDataset &dataset, InstanceHeader &h) {
    h.hasPixels = dataset.tagExists(DCM_PixelData) == OFTrue;
    h.floatPixels =
        dataset.tagExists(DCM_FloatPixelData) || dataset.tagExists(DCM_DoubleFloatPixelData);
    h.pixelBytes = pixelBytes(dataset);
    h.rows = readInteger(&dataset, DCM_Rows);
    h.columns = readInteger(&dataset, DCM_Columns);
    h.samplesPerPixel = readInteger(&dataset, DCM_SamplesPerPixel, 1);
    h.bitsAllocated = readInteger(&dataset, DCM_BitsAllocated);
    h.bitsStored = readInteger(&dataset, DCM_BitsStored, h.bitsAllocated);
    h.highBit = readInteger(&dataset, DCM_HighBit, h.bitsStored - 1);
    h.pixelRepresentation = readInteger(&dataset, DCM_PixelRepresentation, -1);
    h.lossy = readText(&dataset, DCM_LossyImageCompression) == "01";
    h.photometric = readText(&dataset, DCM_PhotometricInterpretation);
    h.rescaleType = readText(&dataset, DCM_RescaleType);
    h.isInverse = readText(&dataset, DCM_PresentationLUTShape) == "INVERSE";
    const auto padding = [&](const DcmTagKey &tag) {
        const auto value = readNumber(&dataset, tag);
        return value && std::abs(*value) <= 65536.0 ? std::optional(int(*value)) : std::nullopt;
    };
    h.paddingValue = padding(DCM_PixelPaddingValue);
    h.paddingLimit = padding(DCM_PixelPaddingRangeLimit);
}

// Philips' factor from counts to uptake values is a private element.
double philipsUptakePerCount(DcmDataset &dataset) {
    constexpr Uint16 group = 0x7053;
    const bool isPhilips =
        readText(&dataset, DcmTagKey(group, 0x0010)) == "Philips PET Private Group";
    return isPhilips ? readNumber(&dataset, DcmTagKey(group, 0x1000)).value_or(0.0) : 0.0;
}

void readPet(DcmDataset &dataset, InstanceHeader &h) {
    // Captures of PET have no units; enhanced objects describe the injection in another way.
    if (h.modality != "PT" || !dataset.tagExists(DCM_Units) ||
        h.sopClassUid == UID_EnhancedPETImageStorage)
        return;
    DcmItem *const dose = sequenceItem(&dataset, DCM_RadiopharmaceuticalInformationSequence);
    const auto number = [](DcmItem *item, const DcmTagKey &tag) {
        return readNumber(item, tag).value_or(0.0);
    };
    PetHeader pet;
    pet.units = readText(&dataset, DCM_Units);
    pet.uptakeType = readText(&dataset, DCM_SUVType);
    pet.decayCorrection = readText(&dataset, DCM_DecayCorrection);
    pet.seriesDate = readText(&dataset, DCM_SeriesDate);
    pet.seriesTime = readText(&dataset, DCM_SeriesTime);
    pet.acquisitionDate = readText(&dataset, DCM_AcquisitionDate);
    pet.acquisitionTime = readText(&dataset, DCM_AcquisitionTime);
    pet.weightKg = number(&dataset, DCM_PatientWeight);
    pet.injectionTime = readText(dose, DCM_RadiopharmaceuticalStartTime);
    pet.injectionDateTime = readText(dose, DCM_RadiopharmaceuticalStartDateTime);
    pet.timezone = readText(&dataset, DCM_TimezoneOffsetFromUTC);
    pet.radionuclide = readText(sequenceItem(dose, DCM_RadionuclideCodeSequence), DCM_CodeMeaning);
    constexpr double msPerSecond = 1000.0;
    pet.frameReferenceS = number(&dataset, DCM_FrameReferenceTime) / msPerSecond;
    pet.frameDurationS = number(&dataset, DCM_ActualFrameDuration) / msPerSecond;
    if (DcmSequenceOfItems *all = nullptr;
        dataset.findAndGetSequence(DCM_RadiopharmaceuticalInformationSequence, all).good())
        pet.injections = int(all->card());
    pet.injectedBq = number(dose, DCM_RadionuclideTotalDose);
    pet.halfLifeS = number(dose, DCM_RadionuclideHalfLife);
    pet.uptakePerCount = philipsUptakePerCount(dataset);
    OFString corrections;
    if (dataset.findAndGetOFStringArray(DCM_CorrectedImage, corrections).good())
        pet.corrections = corrections.c_str();
    pet.isDynamic = readText(&dataset, DCM_SeriesType).rfind("DYNAMIC", 0) == 0;
    h.pet = pet;
}

} // namespace

void dropUnreadable(DcmItem &dataset) {
    // Gives access to an element's transfer state, which is protected.
    struct Outcome : DcmObject {
        static OFCondition of(const DcmObject &object) { return object.*&Outcome::errorFlag; }
    };
    std::vector<std::pair<DcmItem *, DcmElement *>> unreadable;
    DcmStack stack;
    while (dataset.nextObject(stack, OFTrue).good()) {
        auto *const element = dynamic_cast<DcmElement *>(stack.top());
        auto *const parent = dynamic_cast<DcmItem *>(stack.elem(1));
        if (element == nullptr || parent == nullptr || !element->isLeaf())
            continue;
        const DcmTagKey tag = element->getTag();
        const bool isPixels =
            tag == DCM_PixelData || tag == DCM_FloatPixelData || tag == DCM_DoubleFloatPixelData;
        if (!isPixels && (Outcome::of(*element).bad() || element->getLengthField() > longestValue))
            unreadable.emplace_back(parent, element);
    }
    for (const auto &[parent, element] : unreadable)
        delete parent->remove(element);
}

InstanceHeader headerOf(DcmDataset &dataset, std::size_t fileBytes) {
    dropUnreadable(dataset);
    InstanceHeader header;
    header.oddities = mendNumbers(dataset);
    const CharacterSets sets(dataset);
    readIdentity(dataset, sets, header);
    readPixelDescription(dataset, header);
    readPet(dataset, header);
    header.windows = readWindows(dataset, sets);
    readModalityTable(dataset, header);
    readFrames(dataset, sets, fileBytes, header);
    return header;
}

InstanceHeader headerOf(const LoadedFile &file, std::size_t fileBytes) {
    DcmDataset &dataset = file.dataset();
    InstanceHeader header = headerOf(dataset, fileBytes);
    header.oddities |= file.oddities;
    header.transferSyntax = syntaxName(file.syntaxUid);
    if (!isDecodable(file.syntaxUid))
        header.unsupportedSyntax = header.transferSyntax;
    if (header.sopClassUid.empty())
        header.sopClassUid = readText(file.format->getMetaInfo(), DCM_MediaStorageSOPClassUID);
    const bool isCompressed = !isNative(file.syntaxUid);
    if (isCompressed && header.pixelBytes > 0)
        header.oddities |= definedLengthPixels;
    else if (isCompressed && !file.isComplete)
        header.oddities |= missingDelimiter;
    if (isCompressed)
        header.pixelBytes = 0;
    return header;
}

namespace {

InstanceHeader parsed(std::span<const std::byte> bytes) {
    const LoadedFile file = loadFile(bytes, Extent::header);
    DcmDataset &dataset = file.dataset();
    InstanceHeader header = headerOf(file, bytes.size());
    const bool isDeflated = file.syntaxUid == UID_DeflatedExplicitVRLittleEndianTransferSyntax;
    // A deflated file is inflated only up to the pixels: whether they exist is found out when they
    // are read.
    header.hasPixels =
        header.hasPixels || (isDeflated && header.rows > 0 && header.bitsAllocated > 0);
    // Plain pixels have a known size; a file that is shorter cannot hold them.
    const double needed = double(header.rows) * header.columns * header.samplesPerPixel *
                          header.bitsAllocated / 8.0 * double(header.frames.size());
    if (header.hasPixels && !isDeflated && !whyUnusable(header) && isNative(file.syntaxUid) &&
        needed > double(bytes.size()))
        throw Error(ErrorCode::unusable, task::because::pixelsTruncated);
    // Attributes after damaged elements are lost, but a complete image before them is not.
    if (!file.isComplete && !(header.hasPixels && header.rows > 0))
        throw Error(ErrorCode::unusable, task::because::isDamagedBy(file.failure));
    if (const auto mosaic = mosaicOf(dataset, header))
        splitTiles(header, *mosaic);
    else if (!whyUnusable(header) && guessedMosaic(dataset, header, {}))
        return decodeImage(bytes).header; // the pixels tell how many tiles are slices
    else if (isMosaic(header))
        header.oddities |= unreadMosaic;
    return header;
}

} // namespace

InstanceHeader parseHeader(std::span<const std::byte> bytes) {
    return orDamaged([&] { return parsed(bytes); });
}

} // namespace pellucid::decoding::process
