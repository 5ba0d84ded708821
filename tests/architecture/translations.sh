#!/usr/bin/env bash
# Every text of the sources is translated, and no translation is of a text that is gone.
# Usage: translations.sh SOURCE_ROOT
set -euo pipefail
cd "$1"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp resources/translations/*.ts "$scratch"
lupdate=/usr/lib/qt6/bin/lupdate
"$lupdate" -silent -I . -no-obsolete -locations none -source-language en -target-language zh_TW ui -ts "$scratch/pellucid_zh_TW.ts" 2>/dev/null
"$lupdate" -silent -I . -no-obsolete -locations none -source-language en -target-language en -pluralonly ui -ts "$scratch/pellucid_en.ts" 2>/dev/null
failed=0
for file in "$scratch"/*.ts; do
    missing=$(grep -B3 'type="unfinished"' "$file" | grep -o '<source>.*</source>' || true)
    if [[ -n $missing ]]; then
        echo "$(basename "$file"): not translated (./dev translations brings the file up to date):"
        echo "$missing"
        failed=1
    fi
    # Places for numbers and names are in both.
    python3 - "$file" <<'PYTHON' || failed=1
import re, sys
import xml.etree.ElementTree as tree
wrong = 0
for message in tree.parse(sys.argv[1]).getroot().iter('message'):
    source, translation = message.find('source').text, message.find('translation')
    texts = [form.text or '' for form in translation.findall('numerusform')] or [translation.text or '']
    places = set(re.findall(r'%(?:\d|n)', source))
    for text in texts:
        if text and set(re.findall(r'%(?:\d|n)', text)) != places:
            print(f'{source!r}: its places are not those of {text!r}')
            wrong = 1
sys.exit(wrong)
PYTHON
done
exit $failed
