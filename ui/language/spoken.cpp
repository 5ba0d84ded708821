// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/language/spoken.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <QCoreApplication>
#include <QRegularExpression>

namespace pellucid::ui {

namespace {

// What may be said, with %1 and on for what is filled in; the longer ones before those that they
// begin with.
constexpr const char *reasons[] = {
    QT_TRANSLATE_NOOP("Reasons", "is not a NRRD, NIfTI or MetaImage file"),
    QT_TRANSLATE_NOOP("Reasons", "the size of the volume is out of range"),
    QT_TRANSLATE_NOOP("Reasons", "the volume is too large"),
    QT_TRANSLATE_NOOP("Reasons", "the origin is farther away than a kilometre"),
    QT_TRANSLATE_NOOP("Reasons",
                      "the samples are closer than a nanometre or farther apart than ten metres"),
    QT_TRANSLATE_NOOP("Reasons", "holds colours; volumes of one value a voxel are supported"),
    QT_TRANSLATE_NOOP("Reasons", "holds several values a voxel; volumes of one are supported"),
    QT_TRANSLATE_NOOP("Reasons", "holds more volumes than any series"),
    QT_TRANSLATE_NOOP("Reasons", "holds fewer volumes than before"),
    QT_TRANSLATE_NOOP("Reasons", "NIfTI data type %1 is not supported"),
    QT_TRANSLATE_NOOP("Reasons", "the NIfTI header has no dimensions"),
    QT_TRANSLATE_NOOP("Reasons", "the NIfTI header says no place of the samples"),
    QT_TRANSLATE_NOOP("Reasons", "has its samples in another file; .nii files hold both"),
    QT_TRANSLATE_NOOP("Reasons", "the MetaImage header has a line without '='"),
    QT_TRANSLATE_NOOP("Reasons", "the MetaImage header has no '%1'"),
    QT_TRANSLATE_NOOP("Reasons", "MetaImage numbers expected: %1"),
    QT_TRANSLATE_NOOP("Reasons", "MetaImage type '%1' is not supported"),
    QT_TRANSLATE_NOOP("Reasons",
                      "only three- and four-dimensional MetaImage volumes are supported"),
    QT_TRANSLATE_NOOP("Reasons", "MetaImage samples as text are not supported"),
    QT_TRANSLATE_NOOP("Reasons", "MetaImage samples in a list of files are not supported"),
    QT_TRANSLATE_NOOP("Reasons", "MetaImage header sizes counted from the end are not supported"),
    QT_TRANSLATE_NOOP("Reasons", "its values, from %1 to %2, differ by less than 24 bits can tell"),
    QT_TRANSLATE_NOOP("Reasons", "values that differ by less than %1 are shown as equal"),
    QT_TRANSLATE_NOOP("Reasons", "all slices have the same position"),
    QT_TRANSLATE_NOOP("Reasons", "%1 is %2 mm off the line through all slices"),
    QT_TRANSLATE_NOOP("Reasons", "missing slices, interpolated: %1"),
    QT_TRANSLATE_NOOP("Reasons", "%1 mm between %2 and %3"),
    QT_TRANSLATE_NOOP("Reasons", "%1 more"),
    QT_TRANSLATE_NOOP("Reasons", "orientations differ by up to %1 degrees; the mean is used"),
    QT_TRANSLATE_NOOP("Reasons", "pixel spacings differ by up to %1 %; the mean is used"),
    QT_TRANSLATE_NOOP("Reasons", "hardly any images share a frame of reference; treated as one"),
    QT_TRANSLATE_NOOP("Reasons", "different images with the same instance UID: %1"),
    QT_TRANSLATE_NOOP("Reasons", "images of one series name %1 studies; shown in the first"),
    QT_TRANSLATE_NOOP("Reasons", "slices %1 to %2 of %3: a gap of %4 mm between %5 and %6"),
    QT_TRANSLATE_NOOP("Reasons", "slice %1 of %2: a gap of %3 mm between %4 and %5"),
    QT_TRANSLATE_NOOP("Reasons", "files coded implicitly that say they are explicit: %1"),
    QT_TRANSLATE_NOOP("Reasons", "files of a compressed syntax with pixels of defined length: %1"),
    QT_TRANSLATE_NOOP("Reasons", "files whose compressed pixels have no end: %1"),
    QT_TRANSLATE_NOOP("Reasons", "files whose pixels have more bits than their header says: %1"),
    QT_TRANSLATE_NOOP("Reasons", "mosaics that could not be taken apart, shown flat: %1"),
    QT_TRANSLATE_NOOP("Reasons", "is unusually large: %1 x %2 x %3 pixels in a file of %4 MB"),
    QT_TRANSLATE_NOOP("Reasons", "transfer syntax not supported: %1"),
    QT_TRANSLATE_NOOP("Reasons", "has %1 samples per pixel; monochrome images have one"),
    QT_TRANSLATE_NOOP("Reasons", "the pixels are not readable"),
    QT_TRANSLATE_NOOP("Reasons", "a compressed frame has no header"),
    QT_TRANSLATE_NOOP("Reasons", "a compressed frame has %1 x %2 pixels, the header says %3 x %4"),
    QT_TRANSLATE_NOOP("Reasons", "a compressed frame has %1 colours"),
    QT_TRANSLATE_NOOP("Reasons", "a compressed frame has %1 bits per sample, the header says %2"),
    QT_TRANSLATE_NOOP(
        "Reasons",
        "a compressed frame is coded otherwise (marker %1) than its transfer syntax says: %2"),
    QT_TRANSLATE_NOOP("Reasons", "compressed pixels without fragments: %1"),
    QT_TRANSLATE_NOOP("Reasons", "a run-length frame has no header"),
    QT_TRANSLATE_NOOP("Reasons", "a run-length frame has wrong offsets"),
    QT_TRANSLATE_NOOP("Reasons", "a run-length frame has %1 segments, %2 expected"),
    QT_TRANSLATE_NOOP("Reasons", "a run-length segment gives %1 bytes, %2 expected"),
    QT_TRANSLATE_NOOP("Reasons", "a run-length segment has %1 bytes more than its image"),
    QT_TRANSLATE_NOOP("Reasons", "JPEG XL: %1"),
    QT_TRANSLATE_NOOP("Reasons", "holds no image"),
    QT_TRANSLATE_NOOP("Reasons", "slices %1 to %2"),
    QT_TRANSLATE_NOOP("Reasons", "slice %1"),
    QT_TRANSLATE_NOOP("Reasons", "gaps filled"),
    QT_TRANSLATE_NOOP("Reasons", "many files"),
    QT_TRANSLATE_NOOP("Reasons", "planes are not at right angles"),
    QT_TRANSLATE_NOOP("Reasons", "was decoded to nonsense"),
    QT_TRANSLATE_NOOP("Reasons", "takes too long to read"),
    QT_TRANSLATE_NOOP("Reasons", "needs %1 MB of memory, there are %2 MB"),
    QT_TRANSLATE_NOOP("Reasons", "the decoder cannot be started: %1"),
    QT_TRANSLATE_NOOP("Reasons", "has sequences nested too deeply"),
    QT_TRANSLATE_NOOP("Reasons", "holds more files than it announces"),
    QT_TRANSLATE_NOOP("Reasons", "is so damaged that the decoder crashed"),
    QT_TRANSLATE_NOOP("Reasons", "made the decoder try what no image needs"),
    QT_TRANSLATE_NOOP(
        "Reasons",
        "a spectrum of %1 x %2 x %3 cells is larger than the graphics card's textures, %4 a side"),
    QT_TRANSLATE_NOOP("Reasons",
                      "the image reaches further than the graphics card's slice can count"),
    QT_TRANSLATE_NOOP("Reasons",
                      "means, %1 x %2 x %3 in place of %4 x %5 x %6: more does not fit the memory"),
    QT_TRANSLATE_NOOP("Reasons", "uneven slice distances, resampled onto %1 mm; they change at %2"),
    QT_TRANSLATE_NOOP("Reasons", "has its samples in another file; referred to, not copied"),
    QT_TRANSLATE_NOOP("Reasons", "OpenGL here is %1.%2; 3.3 is needed to show pictures with it"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory to keep the projections of the layers"),
    QT_TRANSLATE_NOOP("Reasons", "the most accurate that fits the memory with the chosen %1"),
    QT_TRANSLATE_NOOP("Reasons", "the weight %1 of a transfer function is not within 0 and %2"),
    QT_TRANSLATE_NOOP("Reasons", "the cheapest that keeps the tolerance with the chosen %1"),
    QT_TRANSLATE_NOOP("Reasons", "the spectra need %1 MB, the graphics card has %2 MB free"),
    QT_TRANSLATE_NOOP("Reasons", "a fragment of the compressed pixels is not readable"),
    QT_TRANSLATE_NOOP("Reasons", "an image of %1 x %2 pixels needs %3 MB, %4 MB are allowed"),
    QT_TRANSLATE_NOOP("Reasons", "only three-dimensional NRRD volumes are supported"),
    QT_TRANSLATE_NOOP("Reasons", "is an archive; archives are opened by themselves"),
    QT_TRANSLATE_NOOP("Reasons", "the compressed image is not what the header says"),
    QT_TRANSLATE_NOOP("Reasons", "slice distances from %1 to %2 mm have no common step"),
    QT_TRANSLATE_NOOP("Reasons", "the graphics card was lost: its driver was reset"),
    QT_TRANSLATE_NOOP("Reasons", "OpenGL contexts here do not share what they hold"),
    QT_TRANSLATE_NOOP("Reasons", "copies need a study library that can be written"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory for the steps of the class '%1'"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory for the gradient of the field"),
    QT_TRANSLATE_NOOP("Reasons", "announces %1 frames, more than the file can hold"),
    QT_TRANSLATE_NOOP("Reasons", "tilted by %1 degrees; shown from its own lattice"),
    QT_TRANSLATE_NOOP("Reasons", "has its samples in another file; not imported"),
    QT_TRANSLATE_NOOP("Reasons", "'%1' is no parameter of the step '%2', which has %3"),
    QT_TRANSLATE_NOOP("Reasons", "has %1 bits per sample; 8 and 16 are supported"),
    QT_TRANSLATE_NOOP("Reasons", "the graphics card has not enough memory for %1"),
    QT_TRANSLATE_NOOP("Reasons", "the compressed data are damaged or truncated"),
    QT_TRANSLATE_NOOP("Reasons", "unpacks to more than the %1 there is room for"),
    QT_TRANSLATE_NOOP("Reasons",
                      "nothing of the study is visible, so there is no spectrum to show"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory for an image of this size"),
    QT_TRANSLATE_NOOP("Reasons", "the most accurate there is with the chosen %1"),
    QT_TRANSLATE_NOOP("Reasons", "the graphics card does not answer any more"),
    QT_TRANSLATE_NOOP("Reasons", "a transfer function has %1 to %2 weights, not %3"),
    QT_TRANSLATE_NOOP("Reasons", "says that %1 of %2 bits are stored up to bit %3"),
    QT_TRANSLATE_NOOP("Reasons", "the projection needs %1 MB, %2 MB are allowed"),
    QT_TRANSLATE_NOOP("Reasons", "there is no folder for the user's presets"),
    QT_TRANSLATE_NOOP("Reasons", "holds %1 compressed frames, %2 are announced"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory for a volume of %1 x %2 x %3"),
    QT_TRANSLATE_NOOP("Reasons", "floating-point pixels are not supported"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory for the cropped field"),
    QT_TRANSLATE_NOOP("Reasons", "%1; studies are listed for this run only"),
    QT_TRANSLATE_NOOP("Reasons", "the compressed pixels are not readable"),
    QT_TRANSLATE_NOOP("Reasons", "the pixels are truncated: %1 of %2 samples"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory for the class fields"),
    QT_TRANSLATE_NOOP("Reasons", "the most accurate that fits the memory"),
    QT_TRANSLATE_NOOP("Reasons", "there is no folder for temporary files"),
    QT_TRANSLATE_NOOP("Reasons", "is a study library of a newer version"),
    QT_TRANSLATE_NOOP("Reasons", "the image is not what the header says"),
    QT_TRANSLATE_NOOP("Reasons", "has an image larger than DICOM allows"),
    QT_TRANSLATE_NOOP("Reasons", "is listed in the DICOMDIR but missing"),
    QT_TRANSLATE_NOOP("Reasons", "the cheapest that keeps the tolerance"),
    QT_TRANSLATE_NOOP("Reasons", "is larger than such files are (%1 MB)"),
    QT_TRANSLATE_NOOP("Reasons", "has a rescale slope or intercept that gives no values"),
    QT_TRANSLATE_NOOP("Reasons", "holds more samples than its header says"),
    QT_TRANSLATE_NOOP("Reasons", "samples that are no finite numbers: %1"),
    QT_TRANSLATE_NOOP("Reasons", "files with more pixels than their header says: %1"),
    QT_TRANSLATE_NOOP("Reasons", "the NRRD header has '%1' twice"),
    QT_TRANSLATE_NOOP("Reasons", "has more elements than any image"),
    QT_TRANSLATE_NOOP("Reasons", "its decoder was killed, for want of memory perhaps"),
    QT_TRANSLATE_NOOP("Reasons", "the DICOM data dictionary is missing"),
    QT_TRANSLATE_NOOP("Reasons", "the preset '%1' is made for %2, not for %3"),
    QT_TRANSLATE_NOOP("Reasons", "is no volume property of 3D Slicer: %1"),
    QT_TRANSLATE_NOOP("Reasons", "cannot be copied into the library: %1"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory for a basis field"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory for the lit field"),
    QT_TRANSLATE_NOOP("Reasons", "OpenGL here gives no second context"),
    QT_TRANSLATE_NOOP("Reasons", "is an index of files, not an image"),
    QT_TRANSLATE_NOOP("Reasons", "OpenGL here is a software renderer"),
    QT_TRANSLATE_NOOP("Reasons", "there is no libEGL on this machine"),
    QT_TRANSLATE_NOOP("Reasons", "unpacks to more than it announces"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory for the step '%1'"),
    QT_TRANSLATE_NOOP("Reasons", "the OpenGL context cannot be used"),
    QT_TRANSLATE_NOOP("Reasons", "the images have no pixel spacing"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory for the volume"),
    QT_TRANSLATE_NOOP("Reasons", "there is another preset named '%1'"),
    QT_TRANSLATE_NOOP("Reasons", "lists a file outside its folder"),
    QT_TRANSLATE_NOOP("Reasons", "needs more memory than there is"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory to find edges"),
    QT_TRANSLATE_NOOP("Reasons", "the images have no orientation"),
    QT_TRANSLATE_NOOP("Reasons", "is neither a file nor a folder"),
    QT_TRANSLATE_NOOP("Reasons", "the softness must be 0 or more"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory for %1 of %2 MB"),
    QT_TRANSLATE_NOOP("Reasons", "the step '%1' has no parameters"),
    QT_TRANSLATE_NOOP("Reasons", "the decoder cannot be set up"),
    QT_TRANSLATE_NOOP("Reasons", "the graphics card was chosen"),
    QT_TRANSLATE_NOOP("Reasons", "the preset cannot be kept: %1"),
    QT_TRANSLATE_NOOP("Reasons", "the images have no position"),
    QT_TRANSLATE_NOOP("Reasons", "segmentations are not shown"),
    QT_TRANSLATE_NOOP("Reasons", "its opacity is 0 everywhere"),
    QT_TRANSLATE_NOOP("Reasons", "the most accurate there is"),
    QT_TRANSLATE_NOOP("Reasons", "the graphics card was lost"),
    QT_TRANSLATE_NOOP("Reasons", "the scene's schema is not %1"),
    QT_TRANSLATE_NOOP("Reasons", "the NRRD header has no end"),
    QT_TRANSLATE_NOOP("Reasons", "changed while it was read"),
    QT_TRANSLATE_NOOP("Reasons", "cannot be read to its end"),
    QT_TRANSLATE_NOOP("Reasons", "has an image without size"),
    QT_TRANSLATE_NOOP("Reasons", "the NRRD header has no '%1'"),
    QT_TRANSLATE_NOOP("Reasons", "No such file or directory"),
    QT_TRANSLATE_NOOP("Reasons", "the pixels are truncated"),
    QT_TRANSLATE_NOOP("Reasons", "has the instance UID of %1"),
    QT_TRANSLATE_NOOP("Reasons", "the scene is not valid: %1"),
    QT_TRANSLATE_NOOP("Reasons", "the processor was chosen"),
    QT_TRANSLATE_NOOP("Reasons", "there is a graphics card"),
    QT_TRANSLATE_NOOP("Reasons", "the range %1 to %2 is empty"),
    QT_TRANSLATE_NOOP("Reasons", "the step '%1' is none of %2"),
    QT_TRANSLATE_NOOP("Reasons", "No space left on device"),
    QT_TRANSLATE_NOOP("Reasons", "is a damaged archive: %1"),
    QT_TRANSLATE_NOOP("Reasons", "holds more than %1 files"),
    QT_TRANSLATE_NOOP("Reasons", "holds no usable images"),
    QT_TRANSLATE_NOOP("Reasons", "CPU engine, %1, %2 threads"),
    QT_TRANSLATE_NOOP("Reasons", "is a link to a folder"),
    QT_TRANSLATE_NOOP("Reasons", "is not a regular file"),
    QT_TRANSLATE_NOOP("Reasons", "is not there any more"),
    QT_TRANSLATE_NOOP("Reasons", "CPU engine, %1, %2 thread"),
    QT_TRANSLATE_NOOP("Reasons", "the GPU engine needs %1"),
    QT_TRANSLATE_NOOP("Reasons", "ffmpeg does not start"),
    QT_TRANSLATE_NOOP("Reasons", "Read-only file system"),
    QT_TRANSLATE_NOOP("Reasons", "is a damaged archive"),
    QT_TRANSLATE_NOOP("Reasons", "damaged or truncated"),
    QT_TRANSLATE_NOOP("Reasons", "is a colour image (%1)"),
    QT_TRANSLATE_NOOP("Reasons", "the step '%1' failed: %2"),
    QT_TRANSLATE_NOOP("Reasons", "cannot be encoded: %1"),
    QT_TRANSLATE_NOOP("Reasons", "cannot be removed: %1"),
    QT_TRANSLATE_NOOP("Reasons", "cannot be written: %1"),
    QT_TRANSLATE_NOOP("Reasons", "the study library: %1"),
    QT_TRANSLATE_NOOP("Reasons", "is not a DICOM file"),
    QT_TRANSLATE_NOOP("Reasons", "a class has no name"),
    QT_TRANSLATE_NOOP("Reasons", "is no regular file"),
    QT_TRANSLATE_NOOP("Reasons", "is no folder"),
    QT_TRANSLATE_NOOP("Reasons", "the compressed pixels are damaged: %1"),
    QT_TRANSLATE_NOOP("Reasons", "NRRD space units '%1' are not supported"),
    QT_TRANSLATE_NOOP("Reasons", "NRRD units '%1' are not supported"),
    QT_TRANSLATE_NOOP("Reasons", "files whose compressed pixels are damaged: %1"),
    QT_TRANSLATE_NOOP("Reasons", "an empty path leads nowhere"),
    QT_TRANSLATE_NOOP("Reasons", "rescale slopes of 0, taken for 1: %1"),
    QT_TRANSLATE_NOOP("Reasons", "temporal position %1"),
    QT_TRANSLATE_NOOP("Reasons", "ffmpeg ended early"),
    QT_TRANSLATE_NOOP("Reasons", "is not readable: %1"),
    QT_TRANSLATE_NOOP("Reasons", "acquisition time %1"),
    QT_TRANSLATE_NOOP("Reasons", "Permission denied"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory"),
    QT_TRANSLATE_NOOP("Reasons", "cannot be made: %1"),
    QT_TRANSLATE_NOOP("Reasons", "has no pixels (%1)"),
    QT_TRANSLATE_NOOP("Reasons", "is a broken link"),
    QT_TRANSLATE_NOOP("Reasons", "is a link in an archive"),
    QT_TRANSLATE_NOOP("Reasons", "is damaged in the archive: %1"),
    QT_TRANSLATE_NOOP("Reasons", "is not the study that was open here"),
    QT_TRANSLATE_NOOP("Reasons", "not enough memory for a decoder"),
    QT_TRANSLATE_NOOP("Reasons", "is there already"),
    QT_TRANSLATE_NOOP("Reasons", "is not a session"),
    QT_TRANSLATE_NOOP("Reasons", "does not say whether its values are signed"),
    QT_TRANSLATE_NOOP("Reasons",
                      "names no space of the patient; taken for left-posterior-superior"),
    QT_TRANSLATE_NOOP("Reasons", "holds no images"),
    QT_TRANSLATE_NOOP("Reasons", "damaged header"),
    QT_TRANSLATE_NOOP("Reasons", "cannot be read"),
    QT_TRANSLATE_NOOP("Reasons", "does not exist"),
    QT_TRANSLATE_NOOP("Reasons", "Is a directory"),
    QT_TRANSLATE_NOOP("Reasons", "no OpenGL here"),
    QT_TRANSLATE_NOOP("Reasons", "images only: %1"),
    QT_TRANSLATE_NOOP("Reasons", "holds no data"),
    QT_TRANSLATE_NOOP("Reasons", "has no pixels"),
    QT_TRANSLATE_NOOP("Reasons", "trigger time %1"),
    QT_TRANSLATE_NOOP("Reasons", "content time %1"),
    QT_TRANSLATE_NOOP("Reasons", "is damaged: %1"),
    QT_TRANSLATE_NOOP("Reasons", "is encrypted"),
    QT_TRANSLATE_NOOP("Reasons", "acquisition %1"),
    QT_TRANSLATE_NOOP("Reasons", "GPU engine, %1"),
    QT_TRANSLATE_NOOP("Reasons", "is truncated"),
    QT_TRANSLATE_NOOP("Reasons", "its samples are missing: %1"),
    QT_TRANSLATE_NOOP("Reasons", "JPEG 2000: %1"),
    QT_TRANSLATE_NOOP("Reasons", "without %1: %2"),
    QT_TRANSLATE_NOOP("Reasons", "class '%1': %2"),
    QT_TRANSLATE_NOOP("Reasons", "is damaged"),
    QT_TRANSLATE_NOOP("Reasons", "is empty"),
    QT_TRANSLATE_NOOP("Reasons", "b-value %1"),
    QT_TRANSLATE_NOOP("Reasons", "line %1: %2"),
    QT_TRANSLATE_NOOP("Reasons", "stack %1"),
    QT_TRANSLATE_NOOP("Reasons", "echo %1"),
    QT_TRANSLATE_NOOP("Reasons", "type %1"),
    QT_TRANSLATE_NOOP("Reasons", "%1, axial"),
    QT_TRANSLATE_NOOP("Reasons", "%1, coronal"),
    QT_TRANSLATE_NOOP("Reasons", "%1, sagittal"),
    QT_TRANSLATE_NOOP("Reasons", "axial %1"),
    QT_TRANSLATE_NOOP("Reasons", "coronal %1"),
    QT_TRANSLATE_NOOP("Reasons", "sagittal %1"),
    QT_TRANSLATE_NOOP("Reasons", "images %1"),
    QT_TRANSLATE_NOOP("Reasons", "axial"),
    QT_TRANSLATE_NOOP("Reasons", "coronal"),
    QT_TRANSLATE_NOOP("Reasons", "sagittal"),
    QT_TRANSLATE_NOOP("Reasons", "images"),
    QT_TRANSLATE_NOOP("Reasons", "%1 (%2 then %3 mm)"),
    QT_TRANSLATE_NOOP("Reasons", "set %1")};

// Between the parts of a list.
constexpr const char *separator = QT_TRANSLATE_NOOP("Reasons", ", ");

// The names of presets, classes and windows, for whoever translates.
[[maybe_unused]] constexpr const char *names[] = {
    QT_TRANSLATE_NOOP("Names", "X-ray"),
    QT_TRANSLATE_NOOP("Names", "X-ray without couch"),
    QT_TRANSLATE_NOOP("Names", "Bone"),
    QT_TRANSLATE_NOOP("Names", "Bone over soft tissue"),
    QT_TRANSLATE_NOOP("Names", "Lung and airways"),
    QT_TRANSLATE_NOOP("Names", "Skin"),
    QT_TRANSLATE_NOOP("Names", "Contrast vessels"),
    QT_TRANSLATE_NOOP("Names", "Teeth"),
    QT_TRANSLATE_NOOP("Names", "Metal"),
    QT_TRANSLATE_NOOP("Names", "Edges over X-ray"),
    QT_TRANSLATE_NOOP("Names", "Head: bone"),
    QT_TRANSLATE_NOOP("Names", "Head: muscle"),
    QT_TRANSLATE_NOOP("Names", "Head: fluid"),
    QT_TRANSLATE_NOOP("Names", "Head: bone, muscle, fluid"),
    QT_TRANSLATE_NOOP("Names", "Chest: bone"),
    QT_TRANSLATE_NOOP("Names", "Chest: muscle"),
    QT_TRANSLATE_NOOP("Names", "Chest: fat"),
    QT_TRANSLATE_NOOP("Names", "Chest: bone, muscle, fat"),
    QT_TRANSLATE_NOOP("Names", "Bone in relief"),
    QT_TRANSLATE_NOOP("Names", "MR: X-ray-like"),
    QT_TRANSLATE_NOOP("Names", "MR: brain"),
    QT_TRANSLATE_NOOP("Names", "MR: edges"),
    QT_TRANSLATE_NOOP("Names", "Body in three lights"),
    QT_TRANSLATE_NOOP("Names", "Chest: tissues and edges"),
    QT_TRANSLATE_NOOP("Names", "Bonsai: branches"),
    QT_TRANSLATE_NOOP("Names", "Bonsai: leaves"),
    QT_TRANSLATE_NOOP("Names", "Branches"),
    QT_TRANSLATE_NOOP("Names", "Leaves"),
    QT_TRANSLATE_NOOP("Names", "Muscle"),
    QT_TRANSLATE_NOOP("Names", "Fluid"),
    QT_TRANSLATE_NOOP("Names", "Fat"),
    QT_TRANSLATE_NOOP("Names", "Edges"),
    QT_TRANSLATE_NOOP("Names", "Soft tissue"),
    QT_TRANSLATE_NOOP("Names", "Signal"),
    QT_TRANSLATE_NOOP("Names", "Patient"),
    QT_TRANSLATE_NOOP("Names", "Lung"),
    QT_TRANSLATE_NOOP("Names", "Head"),
    QT_TRANSLATE_NOOP("Names", "Density"),
    QT_TRANSLATE_NOOP("Names", "Contrast"),
    QT_TRANSLATE_NOOP("Names", "Air"),
    QT_TRANSLATE_NOOP("Names", "Organ"),
    QT_TRANSLATE_NOOP("Names", "Body"),
    QT_TRANSLATE_NOOP("Names", "Brain"),
    QT_TRANSLATE_NOOP("Names", "Abdomen"),
    QT_TRANSLATE_NOOP("Names", "Mediastinum"),
    QT_TRANSLATE_NOOP("Names", "File"),
    QT_TRANSLATE_NOOP("Names", "Auto"),
    QT_TRANSLATE_NOOP("Names", "Custom"),
    QT_TRANSLATE_NOOP("Names", "Own range")};

struct Template {
    const char *text;
    QRegularExpression form;
};

const std::vector<Template> &templates() {
    static const std::vector<Template> all = [] {
        static const QRegularExpression place("%\\d");
        std::vector<Template> made;
        for (const char *text : reasons) {
            QString form;
            qsizetype from = 0;
            const QString said = QString::fromUtf8(text);
            for (auto places = place.globalMatch(said); places.hasNext();) {
                const QRegularExpressionMatch at = places.next();
                form +=
                    QRegularExpression::escape(said.mid(from, at.capturedStart() - from)) + "(.+?)";
                from = at.capturedEnd();
            }
            form += QRegularExpression::escape(said.mid(from));
            made.push_back({text, QRegularExpression(QRegularExpression::anchoredPattern(form))});
        }
        return made;
    }();
    return all;
}

// Translates each part of a list. If no part has a translation, the text stays as it is.
QString spokenList(const QString &english, const QString &between) {
    const QStringList parts = english.split(between);
    QStringList said;
    for (const QString &part : parts)
        said << spoken(part);
    return said == parts ? english : said.join(QCoreApplication::translate("Reasons", separator));
}

// Translates what a placeholder captured: one text, or a list separated by semicolons. A text that
// is known with its semicolon is no list.
QString spokenArgument(const QString &english) {
    const bool isList =
        english.contains("; ") &&
        std::none_of(templates().begin(), templates().end(), [&](const Template &t) {
            return std::string_view(t.text).find("; ") != std::string_view::npos &&
                   t.form.match(english).hasMatch();
        });
    return isList ? spokenList(english, "; ") : spoken(english);
}

} // namespace

QString spoken(const QString &english) {
    for (const Template &t : templates()) {
        const QRegularExpressionMatch match = t.form.match(english);
        if (!match.hasMatch())
            continue;
        QString said = QCoreApplication::translate("Reasons", t.text);
        if (said == QString::fromUtf8(t.text))
            return english; // English is spoken
        // All at once: what is filled in may hold a place of its own.
        QStringList filled;
        for (int n = 1; n <= match.lastCapturedIndex(); ++n)
            filled << spokenArgument(match.captured(n));
        for (qsizetype n = filled.size(); n > 0; --n)
            said.replace("%" + QString::number(n), QChar(0xe000 + int(n)));
        for (qsizetype n = filled.size(); n > 0; --n)
            said.replace(QChar(0xe000 + int(n)), filled[n - 1]);
        return said;
    }
    // Labels are lists.
    return english.contains(", ") ? spokenList(english, ", ") : english;
}

QString spoken(const std::string &english) {
    return spoken(QString::fromStdString(english));
}

QString spokenName(const std::string &english) {
    return QCoreApplication::translate("Names", english.c_str());
}

} // namespace pellucid::ui
