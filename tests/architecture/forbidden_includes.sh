#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Dependencies flow one way; third-party use shows in the file name. Fails with the lines that break it.
# Usage: forbidden_includes.sh SOURCE_ROOT
set -uo pipefail
cd "$1"
failed=0

# forbid "why" "pattern" files...
forbid() {
    local why=$1 pattern=$2
    shift 2
    local found
    found=$(grep -nE "^[[:space:]]*#[[:space:]]*include[[:space:]]*$pattern" "$@" /dev/null)
    if [[ -n $found ]]; then
        printf '%s\n%s\n\n' "$why" "$found"
        failed=1
    fi
}

files() { find "$@" -name '*.h' -o -name '*.cpp' | sort; }
without() { grep -v -E "$1"; }

forbid "core uses neither Qt nor OpenGL" '<(Q|epoxy/|GL/|EGL/)' $(files core)
forbid "gpu uses no Qt" '<Q' $(files gpu)
forbid "core knows nothing above it" '"(gpu|ui|app)/' $(files core)
forbid "gpu knows nothing above it" '"(ui|app)/' $(files gpu)
forbid "ui knows nothing above it" '"app/' $(files ui)
forbid "fourier and render know nothing of DICOM or ITK" '["<](core/(dicom|preprocess)/|dcmtk/|itk)' $(files core/fourier core/render)
forbid "fourier does not know render" '"core/render/' $(files core/fourier)
forbid "volume knows no other station" '"core/(dicom|classify|fourier|render|mpr|phantom|reference)/' $(files core/volume)
forbid "DCMTK is used in core/dicom/*_dcmtk.cpp and core/parse/*_dcmtk.cpp only" '<dcmtk/' $(files core gpu ui app | without '^core/(dicom|parse)/[a-z_]*_dcmtk\.cpp$')
forbid "untrusted bytes are parsed in pellucid-decode only" '"core/parse/(parse|serve|memory_input|dataset|damage)\.h"' $(files core gpu ui app | without '^(core/parse|app/decode)/')
forbid "seccomp is used in *_seccomp.cpp only" '<seccomp' $(files core gpu ui app | without '_seccomp\.cpp$')
forbid "ITK is used in core/preprocess/*_itk.cpp only" '[<"]itk' $(files core gpu ui app | without '^core/preprocess/[a-z_]*_itk\.cpp$')
forbid "FFTW is used in core/fourier/transform_fftw.cpp only" '<fftw3' $(files core gpu ui app | without '^core/fourier/transform_fftw\.cpp$')
forbid "OpenJPEG is used in *_openjpeg.cpp only" '<openjpeg' $(files core gpu ui app | without '_openjpeg\.cpp$')
forbid "zlib is used in *_zlib.cpp only" '<zlib' $(files core gpu ui app | without '_zlib\.cpp$')
forbid "libpng is used in *_libpng.cpp only" '<png' $(files core gpu ui app | without '_libpng\.cpp$')
forbid "libarchive is used in *_libarchive.cpp only" '<archive' $(files core gpu ui app | without '_libarchive\.cpp$')
forbid "spdlog is used in *_spdlog.cpp only" '<spdlog' $(files core gpu ui app | without '_spdlog\.cpp$')
forbid "libepoxy is used in *_epoxy.cpp only" '<epoxy/' $(files core gpu ui app | without '_epoxy\.cpp$')
forbid "JSON is read and written in *_nlohmann.cpp and by the programs only" '<nlohmann' $(files core gpu ui | without '_nlohmann\.(cpp|h)$')
forbid "public headers name no third party but GLM" '<(tbb|fmt|nlohmann|spdlog|CLI|fftw3|dcmtk|openjpeg|zlib|png|epoxy|hwy)' $(files core gpu ui | grep '\.h$' | without '_nlohmann\.h$')
forbid "a *_nlohmann.h is for *_nlohmann.cpp" '"core/.*_nlohmann\.h"' $(files core gpu ui app tests | without '_nlohmann\.(cpp|h)$')
forbid "the bench runs on bare machines" '["<](core/(dicom|preprocess)/|ui/|Q)' $(files app/bench)

# In the first lines, below the interpreter's and the document's own.
mapfile -t sources < <(find app core gpu ui tests shaders packaging -regex '.*\.\(h\|cpp\|inc\|glsl\|comp\|vert\|frag\|sh\|py\)' | sort)
((${#sources[@]} > 300)) || { echo "where are the sources?"; failed=1; }
for file in "${sources[@]}" dev .ci/run; do
    if ! head -3 "$file" | grep -qE '^(//|#) SPDX-License-Identifier: GPL-3.0-or-later$'; then
        echo "$file has no SPDX line"
        failed=1
    fi
done
exit $failed
