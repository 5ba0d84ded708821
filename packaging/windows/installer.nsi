; SPDX-License-Identifier: GPL-3.0-or-later
; The installer: for this user, without an administrator, or for all users. Built by package.sh, which defines VERSION, OUT and
; ICON, and writes the macros INSTALL_FILES and REMOVE_FILES into FILES.
;   pellucid-VERSION-windows-x86_64.exe [/CurrentUser | /AllUsers] [/S] [/D=FOLDER]
; Exit codes: 0 installed, 1 cancelled, 2 not possible.
; An installation is complete or absent: everything is unpacked beside the folder, which is replaced at the end.
Unicode true
Target amd64-unicode
!include LogicLib.nsh
!include MUI2.nsh
!include FileFunc.nsh
!include nsDialogs.nsh
!include WinVer.nsh
!include "${FILES}"

Name "Pellucid"
BrandingText "Pellucid ${VERSION}"
OutFile "${OUT}"
RequestExecutionLevel user
ManifestDPIAware true
SetCompressor /SOLID lzma
SetDateSave off
!ifdef SIGN
    !uninstfinalize '"${SIGN}" --sign "%1"' = 0
!endif
VIProductVersion "${VERSION}.0"
VIAddVersionKey /LANG=0 "ProductName" "Pellucid"
VIAddVersionKey /LANG=0 "FileDescription" "Installs Pellucid"
VIAddVersionKey /LANG=0 "FileVersion" "${VERSION}"
VIAddVersionKey /LANG=0 "LegalCopyright" "The Pellucid developers; GPL-3.0-or-later"

!define UNINSTALL_KEY "Software\Microsoft\Windows\CurrentVersion\Uninstall\Pellucid"
!define CLASSES "Software\Classes"
!define PROGRAM "bin\pellucid.exe"

Var forAll      ; 1: for all users
Var isChosen    ; 1: by an option
Var givenFolder ; by /D=
Var dataFolder  ; of the user's own data
Var forAllButton

!define MUI_ICON "${ICON}"
!define MUI_UNICON "${ICON}"
!define MUI_ABORTWARNING
Page custom askForWhom answeredForWhom
!define MUI_PAGE_CUSTOMFUNCTION_LEAVE checkFolder
!insertmacro MUI_PAGE_DIRECTORY
!insertmacro MUI_PAGE_INSTFILES
!define MUI_FINISHPAGE_RUN
!define MUI_FINISHPAGE_RUN_FUNCTION startProgram
!insertmacro MUI_PAGE_FINISH
!insertmacro MUI_UNPAGE_CONFIRM
!insertmacro MUI_UNPAGE_INSTFILES
!insertmacro MUI_LANGUAGE "English"
!insertmacro MUI_LANGUAGE "TradChinese"

!macro TEXT name english chinese
    LangString ${name} ${LANG_ENGLISH} "${english}"
    LangString ${name} ${LANG_TRADCHINESE} "${chinese}"
!macroend
!insertmacro TEXT forWhom "Choose who can use Pellucid" "選擇誰可以使用 Pellucid"
!insertmacro TEXT forWhomLine "Installing only for you needs no administrator." "只為您自己安裝時，不需要系統管理員。"
!insertmacro TEXT onlyMe "Only for &me" "只為我(&M)"
!insertmacro TEXT everybody "For &all users of this computer (needs an administrator)" "為這台電腦的所有使用者(&A)（需要系統管理員）"
!insertmacro TEXT needsWindows "Pellucid needs Windows 10 or 11." "Pellucid 需要 Windows 10 或 11。"
!insertmacro TEXT needsAdministrator "Only an administrator can install Pellucid for all users." "只有系統管理員可以為所有使用者安裝 Pellucid。"
!insertmacro TEXT notOurs "$INSTDIR contains other files, or is for Pellucid's data. Choose an empty folder." "$INSTDIR 已有其他檔案，或用於存放 Pellucid 的資料。請選擇空的資料夾。"
!insertmacro TEXT isRunning "Pellucid is running, or another program uses one of its files. Close it and try again." "Pellucid 正在執行，或其他程式正在使用其檔案。請關閉後再試一次。"
!insertmacro TEXT notReplaced "$INSTDIR cannot be replaced: another program uses a file in it, or the folder is protected. Nothing was changed." "無法取代 $INSTDIR：其他程式正在使用其中的檔案，或資料夾受到保護。沒有任何變更。"
!insertmacro TEXT notWritten "Not everything could be written to $INSTDIR: is the disk full, or the folder protected? Nothing was changed." "無法將所有檔案寫入 $INSTDIR：磁碟是否已滿，或資料夾受到保護？沒有任何變更。"
!insertmacro TEXT removeData "Also delete your presets, measurements, settings, and lists of studies and servers? They cannot be recovered." "是否也要刪除您的預設集、測量、設定，以及檢查與伺服器清單？這些資料無法復原。"
!insertmacro TEXT removeImages "The study library contains images that were retrieved from servers or copied from discs. Delete them, too?" "檢查資料庫中有自伺服器取回或自光碟複製的影像。是否也要刪除？"
!insertmacro TEXT isInTheWay "The folder $INSTDIR.new was not made by this installer. Rename or delete it, and try again." "資料夾 $INSTDIR.new 不是此安裝程式建立的。請將其重新命名或刪除後再試一次。"
!insertmacro TEXT openIn "Open in Pellucid" "以 Pellucid 開啟"
!insertmacro TEXT dicomFile "DICOM file" "DICOM 檔案"
!insertmacro TEXT volumeFile "Volume" "體積資料"

; Ends with a message; a silent installer has only the exit code.
!macro REFUSE text
    MessageBox MB_OK|MB_ICONSTOP "${text}" /SD IDOK
    SetErrorLevel 2
    Quit
!macroend

; $0: whether a folder is an installation of Pellucid, whose files its uninstaller knows.
!macro IS_INSTALLATION folder
    StrCpy $0 0
    ${If} ${FileExists} "${folder}\uninstall.exe"
    ${AndIf} ${FileExists} "${folder}\${PROGRAM}"
    ${AndIf} ${FileExists} "${folder}\share\doc\pellucid\*.*"
        StrCpy $0 1
    ${EndIf}
!macroend
; Removes an installation's files, and the folder if nothing else is in it.
!macro REMOVE_INSTALLATION folder
    !insertmacro IS_INSTALLATION "${folder}"
    ${If} $0 == 1
        ExecWait '"${folder}\uninstall.exe" /S /FilesOnly _?=${folder}'
        Delete "${folder}\uninstall.exe"
    ${EndIf}
    RMDir "${folder}"
    ${If} ${FileExists} "${folder}\*.*"
        DetailPrint "${folder}: files that are not Pellucid's"
    ${EndIf}
!macroend

; $5: set to 1 if a program runs: its file cannot be written to.
!macro LOOK_AT folder name
    ClearErrors
    ${If} ${FileExists} "${folder}\bin\${name}"
        FileOpen $0 "${folder}\bin\${name}" a
        ${If} ${Errors}
            StrCpy $5 1
        ${Else}
            FileClose $0
        ${EndIf}
    ${EndIf}
!macroend
; Waits until the programs in a folder have ended. If the user gives up, runs `undo` and ends with 2.
!macro AWAIT_END folder undo
    ${Do}
        StrCpy $5 0
        !insertmacro LOOK_AT "${folder}" "pellucid.exe"
        !insertmacro LOOK_AT "${folder}" "pellucid-cli.exe"
        !insertmacro LOOK_AT "${folder}" "pellucid-bench.exe"
        !insertmacro LOOK_AT "${folder}" "pellucid-decode.exe"
        !insertmacro LOOK_AT "${folder}" "pellucid-net.exe"
        ${If} $5 == 0
            ${ExitDo}
        ${EndIf}
        StrCpy $6 1
        MessageBox MB_RETRYCANCEL|MB_ICONEXCLAMATION "$(isRunning)" /SD IDCANCEL IDCANCEL +2
        StrCpy $6 0
        ${If} $6 == 1
            ${undo}
            SetErrorLevel 2
            Quit
        ${EndIf}
    ${Loop}
!macroend

Function useContext
    SetRegView 64
    ${If} $forAll == 1
        SetShellVarContext all
    ${Else}
        SetShellVarContext current
    ${EndIf}
FunctionEnd

; The folder of /D=, of the existing installation, or the default.
Function findFolder
    Call useContext
    ${If} $givenFolder != ""
        StrCpy $INSTDIR $givenFolder
        Return
    ${EndIf}
    ReadRegStr $INSTDIR SHCTX "${UNINSTALL_KEY}" "InstallLocation"
    ${If} $INSTDIR == ""
        ${If} $forAll == 1
            StrCpy $INSTDIR "$PROGRAMFILES64\Pellucid"
        ${Else}
            StrCpy $INSTDIR "$LOCALAPPDATA\Programs\Pellucid"
        ${EndIf}
    ${EndIf}
FunctionEnd

; $0: whether this process is an administrator's.
Function isAdministrator
    UserInfo::GetAccountType
    Pop $0
    ${If} $0 == "Admin"
        StrCpy $0 1
    ${Else}
        StrCpy $0 0
    ${EndIf}
FunctionEnd

Function .onInit
    SetRegView 64
    ${IfNot} ${AtLeastWin10}
        !insertmacro REFUSE "$(needsWindows)"
    ${EndIf}
    ${GetParameters} $1
    StrCpy $forAll 0
    StrCpy $isChosen 0
    StrCpy $dataFolder "$LOCALAPPDATA\Pellucid"
    ; An upgrade is for the same users as the installed version.
    ReadRegStr $2 HKCU "${UNINSTALL_KEY}" "InstallLocation"
    ReadRegStr $3 HKLM "${UNINSTALL_KEY}" "InstallLocation"
    ${If} $2 == ""
    ${AndIf} $3 != ""
        StrCpy $forAll 1
    ${EndIf}
    ClearErrors
    ${GetOptions} $1 "/AllUsers" $2
    ${IfNot} ${Errors}
        StrCpy $isChosen 1
        StrCpy $forAll 1
    ${EndIf}
    ClearErrors
    ${GetOptions} $1 "/CurrentUser" $2
    ${IfNot} ${Errors}
        StrCpy $isChosen 1
        StrCpy $forAll 0
    ${EndIf}
    StrCpy $givenFolder $INSTDIR
    Call findFolder
    ${If} ${Silent}
        Call isAdministrator
        ${If} $forAll == 1
        ${AndIf} $0 == 0
            !insertmacro REFUSE "$(needsAdministrator)"
        ${EndIf}
        Call isOurs
        ${If} $0 == 0
            !insertmacro REFUSE "$(notOurs)"
        ${EndIf}
    ${EndIf}
FunctionEnd

Function askForWhom
    ${If} $isChosen == 1
        Abort ; no page
    ${EndIf}
    !insertmacro MUI_HEADER_TEXT "$(forWhom)" "$(forWhomLine)"
    nsDialogs::Create 1018
    Pop $0
    ${NSD_CreateRadioButton} 0 0 100% 12u "$(onlyMe)"
    Pop $1
    ${NSD_CreateRadioButton} 0 18u 100% 12u "$(everybody)"
    Pop $forAllButton
    ${If} $forAll == 1
        ${NSD_Check} $forAllButton
    ${Else}
        ${NSD_Check} $1
    ${EndIf}
    nsDialogs::Show
FunctionEnd

Function answeredForWhom
    ${NSD_GetState} $forAllButton $forAll
    Call isAdministrator
    ${If} $forAll == 1
    ${AndIf} $0 == 0
        ; The same installer, as an administrator.
        ClearErrors
        StrCpy $0 "/AllUsers"
        ${If} $givenFolder != ""
            StrCpy $0 "/AllUsers /D=$givenFolder"
        ${EndIf}
        ExecShell "runas" "$EXEPATH" "$0"
        ${If} ${Errors}
            Abort ; the user has refused
        ${EndIf}
        Quit
    ${EndIf}
    Call findFolder
FunctionEnd

; $0: whether the folder is absent, empty or an installation, and not for data.
Function isOurs
    StrLen $1 "$dataFolder\"
    StrCpy $2 "$INSTDIR\" $1
    ${If} $2 == "$dataFolder\"
        StrCpy $0 0
        Return
    ${EndIf}
    StrCpy $0 1
    ${If} ${FileExists} "$INSTDIR\*.*"
        !insertmacro IS_INSTALLATION "$INSTDIR"
        ${If} $0 == 1
            Return
        ${EndIf}
        StrCpy $0 1
        ${DirState} "$INSTDIR" $1
        ${If} $1 == 1
            StrCpy $0 0
        ${EndIf}
    ${EndIf}
FunctionEnd

Function checkFolder
    Call isOurs
    ${If} $0 == 0
        StrCpy $INSTDIR "$INSTDIR\Pellucid" ; a folder of programs, such as D:\Programs
        Call isOurs
        ${If} $0 == 1
            ${NSD_SetText} $mui.DirectoryPage.Directory $INSTDIR
            Abort ; the page shows it
        ${EndIf}
        StrCpy $INSTDIR $INSTDIR -9
        MessageBox MB_OK|MB_ICONEXCLAMATION "$(notOurs)"
        Abort
    ${EndIf}
FunctionEnd

; Explorer starts it as the user, not as the administrator who installs it.
Function startProgram
    Exec '"$WINDIR\explorer.exe" "$INSTDIR\${PROGRAM}"'
FunctionEnd

; A kind of file, which Pellucid opens by default only if no other program does.
!macro FILE_TYPE extension class
    WriteRegStr SHCTX "${CLASSES}\.${extension}\OpenWithProgids" "${class}" ""
    WriteRegStr SHCTX "Software\Pellucid\Capabilities\FileAssociations" ".${extension}" "${class}"
    ReadRegStr $0 HKCR ".${extension}" ""
    ${If} $0 == ""
        WriteRegStr SHCTX "${CLASSES}\.${extension}" "" "${class}"
    ${EndIf}
!macroend
!macro CLASS class text
    WriteRegStr SHCTX "${CLASSES}\${class}" "" "${text}"
    WriteRegStr SHCTX "${CLASSES}\${class}\DefaultIcon" "" "$INSTDIR\${PROGRAM},0"
    WriteRegStr SHCTX "${CLASSES}\${class}\shell\open\command" "" '"$INSTDIR\${PROGRAM}" "%1"'
!macroend
!macro EACH_TYPE do
    !insertmacro ${do} "dcm" "Pellucid.dicom"
    !insertmacro ${do} "dicom" "Pellucid.dicom"
    !insertmacro ${do} "nrrd" "Pellucid.volume"
    !insertmacro ${do} "nhdr" "Pellucid.volume"
    !insertmacro ${do} "nii" "Pellucid.volume"
    !insertmacro ${do} "mha" "Pellucid.volume"
    !insertmacro ${do} "mhd" "Pellucid.volume"
!macroend

Section
    Call useContext
    StrCpy $9 $INSTDIR
    ; An interrupted installation leaves its mark, or all files.
    !insertmacro IS_INSTALLATION "$9.new"
    ${If} $0 == 1
    ${OrIf} ${FileExists} "$9.new\unfinished"
        RMDir /r "$9.new"
    ${EndIf}
    RMDir "$9.new"
    ${If} ${FileExists} "$9.new\*.*"
        !insertmacro REFUSE "$(isInTheWay)"
    ${EndIf}
    ReadRegStr $4 SHCTX "${UNINSTALL_KEY}" "InstallLocation"
    ClearErrors
    CreateDirectory "$9.new"
    FileOpen $0 "$9.new\unfinished" w
    FileClose $0
    StrCpy $INSTDIR "$9.new" ; what the macro unpacks to
    !insertmacro INSTALL_FILES
    WriteUninstaller "$INSTDIR\uninstall.exe"
    SetOutPath $TEMP ; the current folder cannot be renamed
    StrCpy $INSTDIR $9
    ${If} ${Errors}
        RMDir /r "$INSTDIR.new"
        !insertmacro REFUSE "$(notWritten)"
    ${EndIf}
    !insertmacro AWAIT_END "$INSTDIR" 'RMDir /r "$INSTDIR.new"'
    ${If} $4 != ""
        !insertmacro AWAIT_END "$4" 'RMDir /r "$INSTDIR.new"'
    ${EndIf}
    Delete "$INSTDIR.new\unfinished"
    ; An earlier .old folder may remain, because others have put files there.
    StrCpy $8 "$INSTDIR.old"
    ${For} $7 2 99
        ${IfNot} ${FileExists} "$8\*.*"
            ${ExitFor}
        ${EndIf}
        StrCpy $8 "$INSTDIR.old$7"
    ${Next}
    ClearErrors
    ${If} ${FileExists} "$INSTDIR\*.*"
        Rename "$INSTDIR" "$8"
    ${EndIf}
    ${IfNot} ${Errors}
        Rename "$INSTDIR.new" "$INSTDIR"
        ${If} ${Errors}
            Rename "$8" "$INSTDIR"
            SetErrors
        ${EndIf}
    ${EndIf}
    ${If} ${Errors}
        RMDir /r "$INSTDIR.new"
        !insertmacro REFUSE "$(notReplaced)"
    ${EndIf}
    !insertmacro REMOVE_INSTALLATION "$8"
    ${If} $4 != ""
    ${AndIf} $4 != $INSTDIR
        !insertmacro REMOVE_INSTALLATION "$4"
    ${EndIf}

    CreateShortcut /NoWorkingDir "$SMPROGRAMS\Pellucid.lnk" "$INSTDIR\${PROGRAM}"
    !insertmacro CLASS "Pellucid.dicom" "$(dicomFile)"
    !insertmacro CLASS "Pellucid.volume" "$(volumeFile)"
    !insertmacro EACH_TYPE FILE_TYPE
    !insertmacro CLASS "pellucid" "URL:Pellucid"
    WriteRegStr SHCTX "${CLASSES}\pellucid" "URL Protocol" ""
    WriteRegStr SHCTX "${CLASSES}\Directory\shell\Pellucid" "" "$(openIn)"
    WriteRegStr SHCTX "${CLASSES}\Directory\shell\Pellucid" "Icon" "$INSTDIR\${PROGRAM},0"
    WriteRegStr SHCTX "${CLASSES}\Directory\shell\Pellucid\command" "" '"$INSTDIR\${PROGRAM}" "%1"'
    WriteRegStr SHCTX "Software\Pellucid\Capabilities" "ApplicationName" "Pellucid"
    WriteRegStr SHCTX "Software\Pellucid\Capabilities" "ApplicationDescription" "DICOM"
    WriteRegStr SHCTX "Software\Pellucid\Capabilities\UrlAssociations" "pellucid" "pellucid"
    WriteRegStr SHCTX "Software\RegisteredApplications" "Pellucid" "Software\Pellucid\Capabilities"
    ${RefreshShellIcons}

    WriteRegStr SHCTX "${UNINSTALL_KEY}" "DisplayName" "Pellucid"
    WriteRegStr SHCTX "${UNINSTALL_KEY}" "DisplayVersion" "${VERSION}"
    WriteRegStr SHCTX "${UNINSTALL_KEY}" "Publisher" "The Pellucid developers"
    WriteRegStr SHCTX "${UNINSTALL_KEY}" "DisplayIcon" "$INSTDIR\${PROGRAM},0"
    WriteRegStr SHCTX "${UNINSTALL_KEY}" "InstallLocation" "$INSTDIR"
    WriteRegStr SHCTX "${UNINSTALL_KEY}" "UninstallString" '"$INSTDIR\uninstall.exe"'
    WriteRegStr SHCTX "${UNINSTALL_KEY}" "QuietUninstallString" '"$INSTDIR\uninstall.exe" /S'
    WriteRegDWORD SHCTX "${UNINSTALL_KEY}" "NoModify" 1
    WriteRegDWORD SHCTX "${UNINSTALL_KEY}" "NoRepair" 1
    ${GetSize} "$INSTDIR" "/S=0K" $0 $1 $2
    WriteRegDWORD SHCTX "${UNINSTALL_KEY}" "EstimatedSize" $0
SectionEnd

; ---- Removing

Var filesOnly
Var forEveryone

Function un.onInit
    SetRegView 64
    ${GetParameters} $1
    ClearErrors
    ${GetOptions} $1 "/FilesOnly" $2
    StrCpy $filesOnly 1
    ${If} ${Errors}
        StrCpy $filesOnly 0
    ${EndIf}
    ReadRegStr $0 HKCU "${UNINSTALL_KEY}" "InstallLocation"
    SetShellVarContext current
    StrCpy $forEveryone 0
    ${If} $0 != $INSTDIR
        StrCpy $forEveryone 1
        SetShellVarContext all
        UserInfo::GetAccountType
        Pop $0
        ${If} $0 != "Admin"
        ${AndIf} $filesOnly == 0
            ${If} ${Silent}
                SetErrorLevel 2
                Quit
            ${EndIf}
            ExecShell "runas" "$INSTDIR\uninstall.exe"
            Quit
        ${EndIf}
    ${EndIf}
FunctionEnd

!macro FORGET_TYPE extension class
    DeleteRegValue SHCTX "${CLASSES}\.${extension}\OpenWithProgids" "${class}"
    DeleteRegKey /ifempty SHCTX "${CLASSES}\.${extension}\OpenWithProgids"
    ReadRegStr $0 SHCTX "${CLASSES}\.${extension}" ""
    ${If} $0 == "${class}"
        DeleteRegValue SHCTX "${CLASSES}\.${extension}" ""
    ${EndIf}
    DeleteRegKey /ifempty SHCTX "${CLASSES}\.${extension}"
!macroend

Section "Uninstall"
    ${If} $filesOnly == 1
        !insertmacro REMOVE_FILES
        Return
    ${EndIf}
    !insertmacro AWAIT_END "$INSTDIR" ""
    !insertmacro REMOVE_FILES
    Delete "$INSTDIR\uninstall.exe"
    RMDir "$INSTDIR"
    Delete "$SMPROGRAMS\Pellucid.lnk"
    !insertmacro EACH_TYPE FORGET_TYPE
    DeleteRegKey SHCTX "${CLASSES}\Pellucid.dicom"
    DeleteRegKey SHCTX "${CLASSES}\Pellucid.volume"
    DeleteRegKey SHCTX "${CLASSES}\pellucid"
    DeleteRegKey SHCTX "${CLASSES}\Directory\shell\Pellucid"
    DeleteRegKey SHCTX "Software\Pellucid\Capabilities"
    DeleteRegKey /ifempty SHCTX "Software\Pellucid"
    DeleteRegValue SHCTX "Software\RegisteredApplications" "Pellucid"
    DeleteRegKey SHCTX "${UNINSTALL_KEY}"
    ${RefreshShellIcons}
    ${If} $forEveryone == 1 ; the administrator who removes it may be somebody else
        Return
    ${EndIf}
    MessageBox MB_YESNO|MB_ICONQUESTION|MB_DEFBUTTON2 "$(removeData)" /SD IDNO IDNO kept
    StrCpy $1 "$LOCALAPPDATA\Pellucid\Data\library"
    StrCpy $2 "$LOCALAPPDATA\Pellucid.images" ; where they are while the rest is deleted
    ${DirState} "$1\files" $0
    ${If} $0 == 1
        MessageBox MB_YESNO|MB_ICONEXCLAMATION|MB_DEFBUTTON2 "$(removeImages)" IDYES deleted
        ClearErrors
        Rename "$1\files" "$2"
        IfErrors kept
        deleted:
    ${EndIf}
    RMDir /r "$LOCALAPPDATA\Pellucid"
    DeleteRegKey HKCU "Software\pellucid"
    ${If} ${FileExists} "$2\*.*"
        CreateDirectory "$1"
        Rename "$2" "$1\files"
    ${EndIf}
    kept:
SectionEnd
