// SPDX-License-Identifier: GPL-3.0-or-later
// Shows a panel alone, with a phantom and a list of the edits. Usage: try_panel PANEL [light]
#include "tests/ui/panels/bench.h"

#include <cstdio>
#include <functional>
#include <map>

#include <QSplitter>
#include <QUndoView>

#include "ui/panels/classes_panel.h"
#include "ui/panels/measurements_panel.h"
#include "ui/panels/presets_panel.h"
#include "ui/panels/problem_list.h"
#include "ui/panels/quality_panel.h"
#include "ui/panels/radiograph_panel.h"
#include "ui/panels/region_bar.h"
#include "ui/panels/shading_panel.h"
#include "ui/panels/transfer_function_panel.h"

namespace pellucid::test {

namespace {

using Made = std::unique_ptr<QWidget>;

template <class Panel> Made make(ui::Document &document) {
    return windowOf(new Panel(document));
}

const std::map<QString, Made (*)(ui::Document &)> panels{
    {"classes", make<ui::ClassesPanel>},
    {"measurements", make<ui::MeasurementsPanel>},
    {"presets", make<ui::PresetsPanel>},
    {"problems", make<ui::ProblemList>},
    {"quality", make<ui::QualityPanel>},
    {"radiograph", make<ui::RadiographPanel>},
    {"regions", make<ui::RegionBar>},
    {"shading", make<ui::ShadingPanel>},
    {"transfer-function", make<ui::TransferFunctionPanel>}};

} // namespace

} // namespace pellucid::test

int main(int argc, char **argv) {
    using namespace pellucid;
    QApplication application(argc, argv);
    QApplication::setApplicationName("pellucid");
    QApplication::setOrganizationName("pellucid");
    const QStringList arguments = QApplication::arguments();
    const auto panel = test::panels.find(arguments.value(1));
    if (panel == test::panels.end()) {
        QStringList names;
        for (const auto &known : test::panels)
            names << known.first;
        std::fprintf(stderr, "try_panel: name a panel: %s\n", qPrintable(names.join(", ")));
        return 2;
    }
    ui::Theme::named(arguments.value(2, "dark")).apply(application);
    ui::Document document;
    QSplitter window;
    window.addWidget(panel->second(document).release());
    window.addWidget(new QUndoView(document.undoStack()));
    test::openPhantom(document);
    window.resize(640, 480);
    window.show();
    return QApplication::exec();
}
