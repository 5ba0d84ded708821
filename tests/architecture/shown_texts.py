#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts from outside reach the screen only as plain text, by the functions of ui/language and the widgets of ui/widgets.

Qt takes some texts for HTML, opens the files that they name, and marks keys where a text has an ampersand. The test
reads the sources, not the types: a value is anything but a text of ours, tr("...").
Usage: shown_texts.py SOURCE_ROOT
"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])

FORBIDDEN = {
    r"QLabel": "PlainLabel",
    r"QMessageBox|QErrorMessage|QProgressDialog|QWizard": "ask()",
    r"setTextFormat": "PlainLabel",
    r"QTextBrowser|QTextEdit|QTextDocument|QStaticText|QGraphicsTextItem|QSplashScreen": "PlainLabel or QPlainTextEdit",
    r"setHtml|insertHtml|setMarkdown|setWhatsThis|setStatusTip|QWhatsThis": "a plain text",
}
ALLOWED = {
    ("ui/window/projection_keys.cpp", "QTextEdit"),  # asks whether the focus is in one
}
STRINGS = r'(?:\s*"(?:[^"\\]|\\.)*")+\s*'
OURS = rf'(?:\w+::)*(?:tr|translate)\({STRINGS}(?:,{STRINGS})?\)|QString\(\)|\{{\}}'
MENUS = "addAction|addMenu|addTab|addButton|QAction|QPushButton|QCheckBox|QRadioButton|QGroupBox"


def without_comments(text):
    """The code, with its line breaks."""

    def blank(found):
        return found[0] if found[0][0] == '"' else "\n" * found[0].count("\n")

    return re.sub(r'"(?:[^"\\\n]|\\.)*"|//[^\n]*|/\*.*?\*/', blank, text, flags=re.S)


def arguments(code, start):
    """The arguments of a call whose parenthesis opens before `start`, and where they end."""
    parts, depth, begin, at = [], 1, start, start
    while depth > 0 and at < len(code):
        if code[at] == '"':
            at = re.compile(r'"(?:[^"\\]|\\.)*"').match(code, at).end()
            continue
        if re.match(r"'(?:[^'\\]|\\.)'", code[at:at + 4]):
            at = code.index("'", at + (3 if code[at + 1] == "\\" else 2)) + 1
            continue
        depth += {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}.get(code[at], 0)
        if (code[at] == "," and depth == 1) or depth == 0:
            parts.append(code[begin:at].strip())
            begin = at + 1
        at += 1
    return parts, at


def is_ours(text, also):
    """Whether an expression is a text of ours, or made safe by the function `also`."""
    if text.startswith(also + "(") and arguments(text, len(also) + 1)[1] == len(text):
        return True
    choice = re.match(r"(?:[^?\"]|\"[^\"]*\")*\?(.*)", text, re.S)
    if choice and ":" in choice[1]:
        first, second = re.split(r"(?<!:):(?!:)", choice[1], 1) if re.search(r"(?<!:):(?!:)", choice[1]) else (text, "")
        return is_ours(first.strip(), also) and is_ours(second.strip(), also)
    return bool(re.fullmatch(OURS, text, re.S))


def faults(path, text):
    code = without_comments(text)
    found = []

    def fault(at, why):
        found.append(f"{path}:{code.count(chr(10), 0, at) + 1}: {why}")

    for words, instead in FORBIDDEN.items():
        for word in re.finditer(rf"\b(?:{words})\b", code):
            if (path, word[0]) not in ALLOWED:
                fault(word.start(), f"{word[0]}: use {instead} of ui/language or ui/widgets")
    for call in re.finditer(r"\b(?:setToolTip|showText)\(", code):
        parts, _ = arguments(code, call.end())
        text = parts[1] if call[0] == "showText(" else parts[-1]
        if not is_ours(text, "plainToolTip"):
            fault(call.start(), "a tooltip with a value: use plainToolTip()")
    for role in re.finditer(r"\bToolTipRole\b", code):
        if not re.match(r":\s*return plainToolTip\(", code[role.end():]):
            fault(role.start(), "a tooltip of an item: use plainToolTip()")
    for call in re.finditer(r"\bsetWindowTitle\(", code):
        text = arguments(code, call.end())[0][0]
        if not is_ours(text, "titleText") and "titleText(" not in text:
            fault(call.start(), "a title with a value: use titleText()")
    for call in re.finditer(rf"\b(?:{MENUS})\(", code):
        text = arguments(code, call.end())[0][0]
        if re.search(r"\btranslatedName\(|\bfromStdString\(|\.arg\(", text) and "menuText(" not in text:
            fault(call.start(), "an action or a button with a value: use menuText()")
    for call in re.finditer(r"\.arg\(", code):
        if re.match(r"\s*\.arg\(", code[arguments(code, call.end())[1]:]):
            fault(call.start(), "the second arg() also fills what the first one inserted: use arg(a, b)")
    return found


# What the test finds, and what it does not take for a fault.
for wrong in (
    "auto *label = new QLabel(name);",
    "QMessageBox::warning(this, tr(\"A\"), text);",
    "button->setToolTip(text);",
    "button->setToolTip(tr(\"Open %1\").arg(name));",
    "button->setToolTip(isOpen ? tr(\"Open\") : name);",
    "button->setToolTip(plainToolTip(name) + other);",
    "item->setToolTip(0, name);",
    "QToolTip::showText(at, name, this);",
    "case Qt::ToolTipRole:\n return name;",
    "item->setData(Qt::ToolTipRole, name);",
    "label->setTextFormat(Qt::AutoText);",
    "text->setHtml(name);",
    "setWindowTitle(name);",
    "menu.addAction(translatedName(name), this);",
    "menu.addAction(tr(\"Send to %1\").arg(server), this);",
    "text = tr(\"%1 of %2\").arg(name)\n.arg(count);",
):
    if len(faults("planted.cpp", wrong)) != 1:
        sys.exit(f"not found: {wrong}")
for right in (
    "auto *label = new PlainLabel(name); // a QLabel",
    "button->setToolTip(tr(\"A, \"\n\"b (Ctrl+C)\"));",
    "button->setToolTip(isOpen ? tr(\"Open\") : QString());",
    "item->setToolTip(0, plainToolTip(name));",
    "QToolTip::showText(at, plainToolTip(name), this);",
    "case Qt::ToolTipRole:\n return plainToolTip(name);",
    "setWindowTitle(tr(\"Log in to %1\").arg(titleText(server)));",
    "menu.addAction(tr(\"Send to %1\").arg(menuText(server)), this);",
    "text = tr(\"%1 of %2\").arg(name, other.arg(count));",
):
    if faults("planted.cpp", right):
        sys.exit(f"no fault: {right}")

wrong = []
sources = [p for top in ("app/pellucid", "ui") for p in sorted((root / top).rglob("*")) if p.suffix in (".h", ".cpp")]
if len(sources) < 200:
    wrong.append("where are the sources?")
for source in sources:
    path = source.relative_to(root).as_posix()
    if path not in ("ui/widgets/plain_label.cpp", "ui/widgets/plain_label.h", "ui/widgets/question.cpp") and not path.startswith("ui/language/"):
        wrong += faults(path, source.read_text())
print("\n".join(wrong))
sys.exit(bool(wrong))
