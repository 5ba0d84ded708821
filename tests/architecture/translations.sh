#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that every text in the sources is translated and that no translation is obsolete. A reason in plain English is
# allowed only in the command line, which speaks English, and in code that reads files of earlier versions.
# Usage: translations.sh SOURCE_ROOT
set -euo pipefail
cd "$1"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp resources/translations/*.ts "$scratch"
resources/translations/update.sh "$scratch" -silent 2>"$scratch/output" || { cat "$scratch/output"; exit 1; }
failed=0
if grep -rn 'because::inWords' core gpu ui | grep -v '^ui/language/kept_reasons\.cpp:'; then
    echo 'these reasons are plain English, which cannot be translated: add a sentence to the reasons.h of the room'
    failed=1
fi
for file in "$scratch"/*.ts; do
    # A translation has the same placeholders as its source.
    python3 - "$file" resources/translations <<'PYTHON' || failed=1
import pathlib, re, sys
import xml.etree.ElementTree as tree
wrong = 0
def messages(path):
    return {(context.find('name').text, message.find('source').text, getattr(message.find('comment'), 'text', None)): message
            for context in tree.parse(path).getroot().iter('context') for message in context.iter('message')}
path = pathlib.Path(sys.argv[1])
wanted = messages(path)
for _, source, _ in messages(pathlib.Path(sys.argv[2]) / path.name).keys() - wanted.keys():
    print(f'{path.name}: no longer in the sources: {source!r} (./dev translations updates the file)')
    wrong = 1
for (_, source, _), message in wanted.items():
    translation = message.find('translation')
    if translation.get('type') == 'unfinished':
        print(f'{path.name}: not translated: {source!r} (./dev translations updates the file)')
        wrong = 1
    texts = [form.text or '' for form in translation.findall('numerusform')] or [translation.text or '']
    places = set(re.findall(r'%(?:\d|n)', source))
    for text in texts:
        if text and set(re.findall(r'%(?:\d|n)', text)) != places:
            print(f'{source!r}: its placeholders differ from those of {text!r}')
            wrong = 1
sys.exit(wrong)
PYTHON
done
# Both manuals have the same chapters, tables and pictures.
for book in manual command_line; do
    for part in '<h3 id="[^"]*"' '<h4 id="[^"]*"' '<tr>' '<img[^>]*' '<pre>'; do
        lists=$(for page in resources/manual/$book*.html; do { grep -o "$part" "$page" || true; } | md5sum; done | sort -u | wc -l)
        if [ "$lists" != 1 ]; then
            echo "resources/manual: the translations of $book.html differ in $part"
            failed=1
        fi
    done
done
exit $failed
