<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en" sourcelanguage="en">
<context>
    <name>HugeQuestionTexts</name>
    <message numerus="yes">
        <source>%n other images are also unusually large.</source>
        <translation>
            <numerusform>%n other image is also unusually large.</numerusform>
            <numerusform>%n other images are also unusually large.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ProjectionTexts</name>
    <message numerus="yes">
        <source>The picture differs from the exact one by %1 (with 98 % confidence by %2), measured at %n frequencies of this study.</source>
        <translation>
            <numerusform>The picture differs from the exact one by %1 (with 98 % confidence by %2), measured at %n frequency of this study.</numerusform>
            <numerusform>The picture differs from the exact one by %1 (with 98 % confidence by %2), measured at %n frequencies of this study.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>StepTexts</name>
    <message numerus="yes">
        <source>%n stroke(s)</source>
        <translation>
            <numerusform>%n stroke</numerusform>
            <numerusform>%n strokes</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n cut(s)</source>
        <translation>
            <numerusform>%n cut</numerusform>
            <numerusform>%n cuts</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>connected to %n point(s)</source>
        <translation>
            <numerusform>connected to %n point</numerusform>
            <numerusform>connected to %n points</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>connected to %n point(s), not through openings narrower than %1 mm</source>
        <translation>
            <numerusform>connected to %n point, not through openings narrower than %1 mm</numerusform>
            <numerusform>connected to %n points, not through openings narrower than %1 mm</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>StudyFactsTexts</name>
    <message numerus="yes">
        <source>%n phases</source>
        <translation>
            <numerusform>%n phase</numerusform>
            <numerusform>%n phases</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>pellucid::ui::EarlierPanel</name>
    <message numerus="yes">
        <source>%1, %n images</source>
        <translation>
            <numerusform>%1, %n image</numerusform>
            <numerusform>%1, %n images</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ProblemList</name>
    <message numerus="yes">
        <source>and %n more</source>
        <translation>
            <numerusform>and %n more</numerusform>
            <numerusform>and %n more</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n files: %1</source>
        <translation>
            <numerusform>%n file: %1</numerusform>
            <numerusform>%n files: %1</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ReceiverForm</name>
    <message numerus="yes">
        <source>%1 receives on port %2; %n objects have arrived</source>
        <translation>
            <numerusform>%1 receives on port %2; %n object has arrived</numerusform>
            <numerusform>%1 receives on port %2; %n objects have arrived</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ServerCommands</name>
    <message numerus="yes">
        <source>The server has corrected this study since %n of its images were received:

%1

Retrieve these images again, and replace the copies on this computer?</source>
        <translation>
            <numerusform>The server has corrected this study since %n of its images was received:

%1

Retrieve this image again, and replace the copy on this computer?</numerusform>
            <numerusform>The server has corrected this study since %n of its images were received:

%1

Retrieve these images again, and replace the copies on this computer?</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>pellucid::ui::StudyList</name>
    <message numerus="yes">
        <source>%1: %n images</source>
        <translation>
            <numerusform>%1: %n image</numerusform>
            <numerusform>%1: %n images</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>pellucid::ui::StudyPanel</name>
    <message numerus="yes">
        <source>%n files that were copied into the library are deleted.</source>
        <translation>
            <numerusform>%n file that was copied into the library is deleted.</numerusform>
            <numerusform>%n files that were copied into the library are deleted.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n files elsewhere stay where they are.</source>
        <translation>
            <numerusform>%n file elsewhere stays where it is.</numerusform>
            <numerusform>%n files elsewhere stay where they are.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>pellucid::ui::TransfersPanel</name>
    <message numerus="yes">
        <source>%n images</source>
        <translation>
            <numerusform>%n image</numerusform>
            <numerusform>%n images</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1 receives on port %2; %n objects have arrived</source>
        <translation>
            <numerusform>%1 receives on port %2; %n object has arrived</numerusform>
            <numerusform>%1 receives on port %2; %n objects have arrived</numerusform>
        </translation>
    </message>
</context>
</TS>
