<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="zh_TW" sourcelanguage="en">
<context>
    <name>Commands</name>
    <message>
        <source>Window</source>
        <translation>窗</translation>
    </message>
    <message>
        <source>Turn the planes</source>
        <translation>轉動切面</translation>
    </message>
</context>
<context>
    <name>CropTool</name>
    <message>
        <source>Crop</source>
        <translation>裁切</translation>
    </message>
</context>
<context>
    <name>DifferenceTexts</name>
    <message>
        <source>aligned: turned by %1°, moved by %2 mm; RMS difference %3, before %4</source>
        <translation>已對齊：旋轉 %1°，移動 %2 mm；差異均方根 %3，之前 %4</translation>
    </message>
    <message>
        <source>not aligned, although the frames of reference differ</source>
        <translation>未對齊，但參考座標系不同</translation>
    </message>
    <message>
        <source>%1 minus %2</source>
        <translation>%1 減 %2</translation>
    </message>
    <message>
        <source>%1 aligned with %2</source>
        <translation>%1 對齊 %2</translation>
    </message>
</context>
<context>
    <name>Dock</name>
    <message>
        <source>Collapse or expand</source>
        <translation>摺疊或展開</translation>
    </message>
</context>
<context>
    <name>FileCommands</name>
    <message>
        <source>&amp;Open files...</source>
        <translation>開啟檔案(&amp;O)…</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>開啟</translation>
    </message>
    <message>
        <source>Open &amp;folder...</source>
        <translation>開啟資料夾(&amp;F)…</translation>
    </message>
    <message>
        <source>&amp;Import into the library...</source>
        <translation>匯入資料庫(&amp;I)…</translation>
    </message>
    <message>
        <source>Import</source>
        <translation>匯入</translation>
    </message>
    <message>
        <source>Ser&amp;vers...</source>
        <translation>伺服器(&amp;V)…</translation>
    </message>
    <message>
        <source>Open se&amp;gmentation...</source>
        <translation>開啟分割檔(&amp;G)...</translation>
    </message>
    <message>
        <source>Su&amp;btract a volume...</source>
        <translation>減去體積(&amp;B)...</translation>
    </message>
    <message>
        <source>&amp;Head</source>
        <translation>頭部(&amp;H)</translation>
    </message>
    <message>
        <source>&amp;Chest</source>
        <translation>胸部(&amp;C)</translation>
    </message>
    <message>
        <source>Open &amp;scene...</source>
        <translation>開啟場景(&amp;S)…</translation>
    </message>
    <message>
        <source>Save s&amp;cene as...</source>
        <translation>另存場景(&amp;C)…</translation>
    </message>
    <message>
        <source>Save classes as segmenta&amp;tion...</source>
        <translation>將類別存為分割檔(&amp;T)...</translation>
    </message>
    <message>
        <source>Save p&amp;icture as...</source>
        <translation>另存影像(&amp;I)…</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>影像</translation>
    </message>
    <message>
        <source>&amp;Export picture...</source>
        <translation>匯出影像(&amp;E)…</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>匯出</translation>
    </message>
    <message>
        <source>Cop&amp;y picture</source>
        <translation>複製影像(&amp;Y)</translation>
    </message>
    <message>
        <source>Pri&amp;nt...</source>
        <translation>列印(&amp;N)…</translation>
    </message>
    <message>
        <source>Export &amp;measurements...</source>
        <translation>匯出測量(&amp;M)…</translation>
    </message>
    <message>
        <source>&amp;DICOM header...</source>
        <translation>DICOM 標頭(&amp;D)…</translation>
    </message>
    <message>
        <source>P&amp;references...</source>
        <translation>偏好設定(&amp;R)…</translation>
    </message>
    <message>
        <source>Clear recent st&amp;udies</source>
        <translation>清除最近的檢查(&amp;U)</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>結束(&amp;Q)</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>復原</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>重做</translation>
    </message>
    <message>
        <source>&amp;Find a study</source>
        <translation>尋找檢查(&amp;F)</translation>
    </message>
    <message>
        <source>&amp;Delete measurement</source>
        <translation>刪除測量(&amp;D)</translation>
    </message>
    <message>
        <source>&amp;Reset layout</source>
        <translation>重設版面(&amp;R)</translation>
    </message>
    <message>
        <source>&amp;Manual</source>
        <translation>使用手冊(&amp;M)</translation>
    </message>
    <message>
        <source>&amp;About Pellucid</source>
        <translation>關於 Pellucid(&amp;A)</translation>
    </message>
</context>
<context>
    <name>HelpTexts</name>
    <message>
        <source>manual.html</source>
        <comment>file name of the translated manual</comment>
        <translation>manual_zh_TW.html</translation>
    </message>
    <message>
        <source>Libraries</source>
        <translation>程式庫</translation>
    </message>
    <message>
        <source>Library</source>
        <translation>程式庫</translation>
    </message>
    <message>
        <source>Version</source>
        <translation>版本</translation>
    </message>
    <message>
        <source>License</source>
        <translation>授權</translation>
    </message>
    <message>
        <source>About Pellucid</source>
        <translation>關於 Pellucid</translation>
    </message>
    <message>
        <source>Projections of DICOM studies in the frequency domain.</source>
        <translation>在頻率域計算 DICOM 檢查的投影。</translation>
    </message>
    <message>
        <source>Not for diagnostic use.</source>
        <translation>不得用於診斷。</translation>
    </message>
    <message>
        <source>Free software under the GNU General Public License, version 3 or later; without any warranty.</source>
        <translation>自由軟體，依 GNU 通用公共授權條款第 3 版或更新版本散布；不提供任何擔保。</translation>
    </message>
</context>
<context>
    <name>HugeQuestionTexts</name>
    <message>
        <source>%1 %2.</source>
        <comment>file name, then what is odd about it</comment>
        <translation>%1 %2。</translation>
    </message>
    <message>
        <source>Opening may use all memory and take a long time.</source>
        <translation>開啟可能耗盡記憶體並花費很長時間。</translation>
    </message>
    <message>
        <source>Unusually large</source>
        <translation>異常龐大</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>開啟</translation>
    </message>
    <message numerus="yes">
        <source>%n other images are also unusually large.</source>
        <translation>
            <numerusform>另有 %n 個影像也異常大。</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>LookCommands</name>
    <message>
        <source>Projection interpolation</source>
        <translation>投影內插</translation>
    </message>
    <message>
        <source>&amp;Save look...</source>
        <translation>儲存外觀(&amp;S)…</translation>
    </message>
    <message>
        <source>&amp;Import preset...</source>
        <translation>匯入預設集(&amp;I)…</translation>
    </message>
    <message>
        <source>&amp;Export preset...</source>
        <translation>匯出預設集(&amp;E)…</translation>
    </message>
    <message>
        <source>&amp;Depth cue</source>
        <translation>深度提示(&amp;D)</translation>
    </message>
    <message>
        <source>Add l&amp;ight</source>
        <translation>新增光源(&amp;I)</translation>
    </message>
    <message>
        <source>Reset s&amp;hading</source>
        <translation>重設明暗(&amp;H)</translation>
    </message>
    <message>
        <source>&amp;Cubic</source>
        <translation>三次(&amp;C)</translation>
    </message>
    <message>
        <source>&amp;Linear</source>
        <translation>線性(&amp;L)</translation>
    </message>
    <message>
        <source>S&amp;pline</source>
        <translation>樣條(&amp;P)</translation>
    </message>
    <message>
        <source>&amp;Sharp (band-limited)</source>
        <translation>銳利（頻帶限制）(&amp;S)</translation>
    </message>
    <message>
        <source>In&amp;verted projection (bone dark)</source>
        <translation>反相投影（骨骼為黑）(&amp;V)</translation>
    </message>
    <message>
        <source>Inverted</source>
        <translation>反相</translation>
    </message>
    <message>
        <source>&amp;Automatic brightness</source>
        <translation>自動亮度(&amp;A)</translation>
    </message>
    <message>
        <source>Automatic brightness</source>
        <translation>自動亮度</translation>
    </message>
    <message>
        <source>Remove the c&amp;ouch</source>
        <translation>移除檢查床(&amp;O)</translation>
    </message>
    <message>
        <source>Automatic window</source>
        <translation>自動視窗</translation>
    </message>
    <message>
        <source>&amp;Inverted grey</source>
        <translation>反轉灰階(&amp;I)</translation>
    </message>
    <message>
        <source>&amp;Width and center...</source>
        <translation>窗寬與窗位(&amp;W)…</translation>
    </message>
</context>
<context>
    <name>MeasureToolTexts</name>
    <message>
        <source>Change %1</source>
        <translation>變更%1</translation>
    </message>
    <message>
        <source>Move %1</source>
        <translation>移動%1</translation>
    </message>
    <message>
        <source>Change text</source>
        <translation>變更文字</translation>
    </message>
</context>
<context>
    <name>MeasurementTextTexts</name>
    <message>
        <source>%1 square pixels</source>
        <translation>%1 平方像素</translation>
    </message>
    <message>
        <source>%1 mm²</source>
        <translation>%1 mm²</translation>
    </message>
    <message>
        <source>%1 cm²</source>
        <translation>%1 cm²</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>距離</translation>
    </message>
    <message>
        <source>Angle</source>
        <translation>角度</translation>
    </message>
    <message>
        <source>Ellipse</source>
        <translation>橢圓</translation>
    </message>
    <message>
        <source>Rectangle</source>
        <translation>矩形</translation>
    </message>
    <message>
        <source>Projected distance</source>
        <translation>投影距離</translation>
    </message>
    <message>
        <source>%1 mm</source>
        <translation>%1 mm</translation>
    </message>
    <message>
        <source>%1 pixels</source>
        <translation>%1 像素</translation>
    </message>
    <message>
        <source>%1°</source>
        <translation>%1°</translation>
    </message>
    <message>
        <source>in the picture, depth not measured</source>
        <translation>影像平面內，未測量深度</translation>
    </message>
    <message>
        <source>mean %1%2</source>
        <translation>平均 %1%2</translation>
    </message>
    <message>
        <source>SD %1</source>
        <translation>標準差 %1</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 至 %2</translation>
    </message>
    <message>
        <source>outside the volume</source>
        <translation>在體積之外</translation>
    </message>
    <message>
        <source>Projected polyline</source>
        <translation>投影折線</translation>
    </message>
    <message>
        <source>Polyline</source>
        <translation>折線</translation>
    </message>
    <message>
        <source>Projected angle</source>
        <translation>投影角度</translation>
    </message>
    <message>
        <source>Projected Cobb angle</source>
        <translation>投影 Cobb 角</translation>
    </message>
    <message>
        <source>Cobb angle</source>
        <translation>Cobb 角</translation>
    </message>
    <message>
        <source>Arrow</source>
        <translation>箭頭</translation>
    </message>
    <message>
        <source>Text</source>
        <translation>文字</translation>
    </message>
    <message>
        <source>at the detector</source>
        <translation>在偵測器上</translation>
    </message>
    <message>
        <source>magnification estimated</source>
        <translation>放大率為估計</translation>
    </message>
    <message>
        <source>corrected for magnification</source>
        <translation>已校正放大率</translation>
    </message>
    <message>
        <source>calibrated</source>
        <translation>已校準</translation>
    </message>
</context>
<context>
    <name>MenuTexts</name>
    <message>
        <source>&amp;File</source>
        <translation>檔案(&amp;F)</translation>
    </message>
    <message>
        <source>Open &amp;phantom</source>
        <translation>開啟假體(&amp;P)</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>編輯(&amp;E)</translation>
    </message>
    <message>
        <source>Projection &amp;engine</source>
        <translation>投影引擎(&amp;E)</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>檢視(&amp;V)</translation>
    </message>
    <message>
        <source>&amp;Look</source>
        <translation>外觀(&amp;L)</translation>
    </message>
    <message>
        <source>P&amp;rojection interpolation</source>
        <translation>投影內插(&amp;R)</translation>
    </message>
    <message>
        <source>&amp;Window presets</source>
        <translation>窗預設值(&amp;W)</translation>
    </message>
    <message>
        <source>W&amp;indow</source>
        <translation>視窗(&amp;I)</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>說明(&amp;H)</translation>
    </message>
</context>
<context>
    <name>Names</name>
    <message>
        <source>X-ray</source>
        <translation>X 光</translation>
    </message>
    <message>
        <source>Bone</source>
        <translation>骨骼</translation>
    </message>
    <message>
        <source>Bone over soft tissue</source>
        <translation>骨骼疊於軟組織</translation>
    </message>
    <message>
        <source>Lung and airways</source>
        <translation>肺與氣道</translation>
    </message>
    <message>
        <source>Skin</source>
        <translation>皮膚</translation>
    </message>
    <message>
        <source>Contrast vessels</source>
        <translation>顯影血管</translation>
    </message>
    <message>
        <source>Teeth</source>
        <translation>牙齒</translation>
    </message>
    <message>
        <source>Metal</source>
        <translation>金屬</translation>
    </message>
    <message>
        <source>Edges over X-ray</source>
        <translation>邊緣疊於 X 光</translation>
    </message>
    <message>
        <source>Head: bone</source>
        <translation>頭部：骨骼</translation>
    </message>
    <message>
        <source>Head: muscle</source>
        <translation>頭部：肌肉</translation>
    </message>
    <message>
        <source>Head: fluid</source>
        <translation>頭部：體液</translation>
    </message>
    <message>
        <source>Head: bone, muscle, fluid</source>
        <translation>頭部：骨骼、肌肉、體液</translation>
    </message>
    <message>
        <source>Chest: bone</source>
        <translation>胸部：骨骼</translation>
    </message>
    <message>
        <source>Chest: muscle</source>
        <translation>胸部：肌肉</translation>
    </message>
    <message>
        <source>Chest: fat</source>
        <translation>胸部：脂肪</translation>
    </message>
    <message>
        <source>Chest: bone, muscle, fat</source>
        <translation>胸部：骨骼、肌肉、脂肪</translation>
    </message>
    <message>
        <source>Bone in relief</source>
        <translation>骨骼浮雕</translation>
    </message>
    <message>
        <source>MR: X-ray-like</source>
        <translation>MR：類 X 光</translation>
    </message>
    <message>
        <source>MR: brain</source>
        <translation>MR：腦</translation>
    </message>
    <message>
        <source>MR: edges</source>
        <translation>MR：邊緣</translation>
    </message>
    <message>
        <source>Body in three lights</source>
        <translation>三色光下的身體</translation>
    </message>
    <message>
        <source>Muscle</source>
        <translation>肌肉</translation>
    </message>
    <message>
        <source>Fluid</source>
        <translation>體液</translation>
    </message>
    <message>
        <source>Fat</source>
        <translation>脂肪</translation>
    </message>
    <message>
        <source>Edges</source>
        <translation>邊緣</translation>
    </message>
    <message>
        <source>Soft tissue</source>
        <translation>軟組織</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>訊號</translation>
    </message>
    <message>
        <source>Patient</source>
        <translation>病患</translation>
    </message>
    <message>
        <source>Lung</source>
        <translation>肺</translation>
    </message>
    <message>
        <source>Head</source>
        <translation>頭部</translation>
    </message>
    <message>
        <source>Density</source>
        <translation>密度</translation>
    </message>
    <message>
        <source>Contrast</source>
        <translation>顯影劑</translation>
    </message>
    <message>
        <source>Air</source>
        <translation>空氣</translation>
    </message>
    <message>
        <source>Organ</source>
        <translation>器官</translation>
    </message>
    <message>
        <source>Body</source>
        <translation>身體</translation>
    </message>
    <message>
        <source>Brain</source>
        <translation>腦</translation>
    </message>
    <message>
        <source>Abdomen</source>
        <translation>腹部</translation>
    </message>
    <message>
        <source>Mediastinum</source>
        <translation>縱膈</translation>
    </message>
    <message>
        <source>File</source>
        <translation>檔案</translation>
    </message>
    <message>
        <source>Auto</source>
        <translation>自動</translation>
    </message>
    <message>
        <source>Custom</source>
        <translation>自訂</translation>
    </message>
    <message>
        <source>Chest: tissues and edges</source>
        <translation>胸部：組織與邊緣</translation>
    </message>
    <message>
        <source>Bonsai: branches</source>
        <translation>盆栽：樹枝</translation>
    </message>
    <message>
        <source>Bonsai: leaves</source>
        <translation>盆栽：樹葉</translation>
    </message>
    <message>
        <source>Branches</source>
        <translation>樹枝</translation>
    </message>
    <message>
        <source>Leaves</source>
        <translation>樹葉</translation>
    </message>
    <message>
        <source>Gain</source>
        <translation>增加</translation>
    </message>
    <message>
        <source>Loss</source>
        <translation>減少</translation>
    </message>
    <message>
        <source>Volume</source>
        <translation>體積</translation>
    </message>
    <message>
        <source>Region</source>
        <translation>區域</translation>
    </message>
    <message>
        <source>Abdomen: gas, organs, bone</source>
        <translation>腹部：氣體、器官、骨骼</translation>
    </message>
    <message>
        <source>Pelvis: bone</source>
        <translation>骨盆：骨骼</translation>
    </message>
    <message>
        <source>Spine: vertebrae</source>
        <translation>脊椎：椎骨</translation>
    </message>
    <message>
        <source>MR angiography: vessels</source>
        <translation>MR 血管攝影：血管</translation>
    </message>
    <message>
        <source>PET: uptake</source>
        <translation>PET：攝取</translation>
    </message>
    <message>
        <source>Organs</source>
        <translation>器官</translation>
    </message>
    <message>
        <source>Gas</source>
        <translation>氣體</translation>
    </message>
    <message>
        <source>Cortical bone</source>
        <translation>皮質骨</translation>
    </message>
    <message>
        <source>End plates</source>
        <translation>終板</translation>
    </message>
    <message>
        <source>Vertebrae</source>
        <translation>椎骨</translation>
    </message>
    <message>
        <source>Vessels</source>
        <translation>血管</translation>
    </message>
    <message>
        <source>Uptake</source>
        <translation>攝取</translation>
    </message>
    <message>
        <source>AP</source>
        <translation>AP</translation>
    </message>
    <message>
        <source>PA</source>
        <translation>PA</translation>
    </message>
    <message>
        <source>Left lateral</source>
        <translation>左側位</translation>
    </message>
    <message>
        <source>Right lateral</source>
        <translation>右側位</translation>
    </message>
    <message>
        <source>AP cranial</source>
        <translation>AP 頭側</translation>
    </message>
    <message>
        <source>AP caudal</source>
        <translation>AP 足側</translation>
    </message>
    <message>
        <source>LAO</source>
        <translation>LAO</translation>
    </message>
    <message>
        <source>RAO</source>
        <translation>RAO</translation>
    </message>
    <message>
        <source>LAO cranial</source>
        <translation>LAO 頭側</translation>
    </message>
    <message>
        <source>Spider (LAO caudal)</source>
        <translation>蜘蛛位（LAO 足側）</translation>
    </message>
    <message>
        <source>RAO cranial</source>
        <translation>RAO 頭側</translation>
    </message>
    <message>
        <source>RAO caudal</source>
        <translation>RAO 足側</translation>
    </message>
    <message>
        <source>Stroke</source>
        <translation>中風</translation>
    </message>
    <message>
        <source>Subdural</source>
        <translation>硬膜下</translation>
    </message>
    <message>
        <source>Angiography</source>
        <translation>血管攝影</translation>
    </message>
    <message>
        <source>SUV 0 to 5</source>
        <translation>SUV 0 至 5</translation>
    </message>
    <message>
        <source>SUV 0 to 10</source>
        <translation>SUV 0 至 10</translation>
    </message>
    <message>
        <source>SUV 0 to 20</source>
        <translation>SUV 0 至 20</translation>
    </message>
</context>
<context>
    <name>OverlayTexts</name>
    <message>
        <source>Warnings omitted</source>
        <translation>已略去警告</translation>
    </message>
</context>
<context>
    <name>PlaneTextsTexts</name>
    <message>
        <source>mean</source>
        <translation>平均</translation>
    </message>
    <message>
        <source>MIP</source>
        <translation>MIP</translation>
    </message>
    <message>
        <source>MinIP</source>
        <translation>MinIP</translation>
    </message>
    <message>
        <source>%1, %2 mm</source>
        <translation>%1，%2 mm</translation>
    </message>
    <message>
        <source>Axial</source>
        <translation>橫斷面</translation>
    </message>
    <message>
        <source>Coronal</source>
        <translation>冠狀面</translation>
    </message>
    <message>
        <source>Sagittal</source>
        <translation>矢狀面</translation>
    </message>
    <message>
        <source>%1, oblique</source>
        <translation>%1，斜切</translation>
    </message>
    <message>
        <source>image %1</source>
        <translation>影像 %1</translation>
    </message>
    <message>
        <source>lossy</source>
        <translation>有損壓縮</translation>
    </message>
    <message>
        <source>interpolated</source>
        <translation>內插</translation>
    </message>
    <message>
        <source>interpolated: no image acquired here</source>
        <translation>內插：此處沒有影像</translation>
    </message>
    <message>
        <source>W %1  C %2</source>
        <comment>window width and center</comment>
        <translation>窗寬 %1  窗位 %2</translation>
    </message>
    <message>
        <source>Not for diagnostic use</source>
        <translation>不得用於診斷</translation>
    </message>
</context>
<context>
    <name>ProjectionTexts</name>
    <message>
        <source>error not known yet</source>
        <translation>誤差未定</translation>
    </message>
    <message>
        <source>coarse</source>
        <translation>粗略</translation>
    </message>
    <message>
        <source>live</source>
        <translation>即時</translation>
    </message>
    <message>
        <source>draft</source>
        <translation>草圖</translation>
    </message>
    <message>
        <source>over 100 %</source>
        <translation>超過 100 %</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>error %1</source>
        <translation>誤差 %1</translation>
    </message>
    <message>
        <source>%1 measured</source>
        <translation>%1 實測</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 至 %2</translation>
    </message>
    <message>
        <source>cancelled (F5 to recompute)</source>
        <translation>已取消（按 F5 重新計算）</translation>
    </message>
    <message>
        <source>failed (F5 to try again)</source>
        <translation>失敗（按 F5 再試一次）</translation>
    </message>
    <message>
        <source>The picture differs from the exact one by at most this fraction (relative L2 error). The error is measured when the view stops moving.</source>
        <translation>影像與精確影像的差別至多為此比例（相對 L2 誤差）。檢視停止移動後即測量誤差。</translation>
    </message>
    <message numerus="yes">
        <source>The picture differs from the exact one by %1 (with 98 % confidence by %2), measured at %n frequencies of this study.</source>
        <translation>
            <numerusform>此影像與精確影像相差 %1（98 % 信賴區間：%2），在此檢查的 %n 個頻率上測得。</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ProjectionView</name>
    <message>
        <source>Before</source>
        <translation>先前</translation>
    </message>
    <message>
        <source>Before: %1</source>
        <translation>先前：%1</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>現在</translation>
    </message>
    <message>
        <source>Projection</source>
        <translation>投影</translation>
    </message>
    <message>
        <source>Parallel projection</source>
        <translation>平行投影</translation>
    </message>
    <message>
        <source>Not for diagnostic use</source>
        <translation>不得用於診斷</translation>
    </message>
    <message>
        <source>Cropped</source>
        <translation>已裁切</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
</context>
<context>
    <name>QObject</name>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1，%2</translation>
    </message>
</context>
<context>
    <name>Reasons</name>
    <message>
        <source>a spectrum of %1 x %2 x %3 cells is larger than the graphics card&apos;s largest texture, %4 a side</source>
        <translation>%1 x %2 x %3 格的頻譜大於顯示卡的最大紋理（每邊 %4）</translation>
    </message>
    <message>
        <source>the image covers more cells than the graphics card can count</source>
        <translation>影像涵蓋的格數超過顯示卡所能計數</translation>
    </message>
    <message>
        <source>averaged to %1 x %2 x %3: the full %4 x %5 x %6 does not fit in memory</source>
        <translation>平均為 %1 x %2 x %3：記憶體容納不下完整的 %4 x %5 x %6</translation>
    </message>
    <message>
        <source>uneven slice spacing, resampled to %1 mm; it changes at %2</source>
        <translation>切片間距不均，重新取樣為 %1 mm；變化處：%2</translation>
    </message>
    <message>
        <source>has its samples in another file; imported by reference, not copied</source>
        <translation>取樣資料在另一個檔案；已參照，未複製</translation>
    </message>
    <message>
        <source>not enough memory to keep the projections of the layers</source>
        <translation>記憶體不足以保留各層的投影</translation>
    </message>
    <message>
        <source>the most accurate that fits in memory with the chosen %1</source>
        <translation>在所選的%1下，記憶體所能容納的最準確做法</translation>
    </message>
    <message>
        <source>the weight %1 of a transfer function is not between 0 and %2</source>
        <translation>轉換函數的權重 %1 不在 0 與 %2 之間</translation>
    </message>
    <message>
        <source>the spectra need %1 MB, but the graphics card has only %2 MB free</source>
        <translation>頻譜需要 %1 MB，顯示卡有 %2 MB 可用</translation>
    </message>
    <message>
        <source>a fragment of the compressed pixel data cannot be read</source>
        <translation>無法讀取壓縮像素的片段</translation>
    </message>
    <message>
        <source>an image of %1 x %2 pixels needs %3 MB, but only %4 MB are allowed</source>
        <translation>%1 x %2 像素的影像需要 %3 MB，允許 %4 MB</translation>
    </message>
    <message>
        <source>only three-dimensional NRRD volumes are supported</source>
        <translation>僅支援三維 NRRD 體積</translation>
    </message>
    <message>
        <source>is an archive; open it separately</source>
        <translation>為壓縮檔；壓縮檔須單獨開啟</translation>
    </message>
    <message>
        <source>the compressed image does not match the header</source>
        <translation>壓縮影像與檔頭不符</translation>
    </message>
    <message>
        <source>slice spacings from %1 to %2 mm have no common step</source>
        <translation>切片間距由 %1 至 %2 mm，沒有共同的步距</translation>
    </message>
    <message>
        <source>the graphics card was lost: its driver was reset</source>
        <translation>失去顯示卡：其驅動程式已重設</translation>
    </message>
    <message>
        <source>not enough memory for the steps of the class &apos;%1&apos;</source>
        <translation>記憶體不足以執行類別「%1」的步驟</translation>
    </message>
    <message>
        <source>not enough memory for the gradient of the field</source>
        <translation>記憶體不足以容納場的梯度</translation>
    </message>
    <message>
        <source>tilted by %1 degrees; shown on its own slanted grid</source>
        <translation>傾斜 %1 度；依其自身格點顯示</translation>
    </message>
    <message>
        <source>the step &apos;%2&apos; has no parameter &apos;%1&apos;; it has %3</source>
        <translation>「%1」不是步驟「%2」的參數，其參數為 %3</translation>
    </message>
    <message>
        <source>the graphics card does not have enough memory for %1</source>
        <translation>顯示卡的記憶體不足以容納%1</translation>
    </message>
    <message>
        <source>the compressed data is damaged or truncated</source>
        <translation>壓縮資料損壞或被截斷</translation>
    </message>
    <message>
        <source>unpacks to more than the %1 available</source>
        <translation>解壓縮後大於可用的 %1</translation>
    </message>
    <message>
        <source>not enough memory for an image of this size</source>
        <translation>記憶體不足以容納此大小的影像</translation>
    </message>
    <message>
        <source>the most accurate with the chosen %1</source>
        <translation>在所選的%1下最準確的做法</translation>
    </message>
    <message>
        <source>the graphics card no longer responds</source>
        <translation>顯示卡不再回應</translation>
    </message>
    <message>
        <source>a transfer function must have %1 to %2 weights, not %3</source>
        <translation>轉換函數必須有 %1 至 %2 個權重，而非 %3 個</translation>
    </message>
    <message>
        <source>has contradictory attributes: Bits Stored %1, Bits Allocated %2, High Bit %3</source>
        <translation>屬性互相矛盾：Bits Stored %1、Bits Allocated %2、High Bit %3</translation>
    </message>
    <message>
        <source>the projection needs %1 MB, but only %2 MB are allowed</source>
        <translation>投影需要 %1 MB，允許 %2 MB</translation>
    </message>
    <message>
        <source>there is no folder for the user&apos;s presets</source>
        <translation>沒有使用者預設集的資料夾</translation>
    </message>
    <message>
        <source>not enough memory for a volume of %1 x %2 x %3</source>
        <translation>記憶體不足以容納 %1 x %2 x %3 的體積</translation>
    </message>
    <message>
        <source>has floating-point pixels, which are not supported</source>
        <translation>不支援浮點像素</translation>
    </message>
    <message>
        <source>%1; studies are listed only until the program closes</source>
        <translation>%1；檢查僅列出至程式關閉為止</translation>
    </message>
    <message>
        <source>the compressed pixel data cannot be read</source>
        <translation>無法讀取壓縮的像素</translation>
    </message>
    <message>
        <source>the pixel data is truncated: %1 of %2 samples</source>
        <translation>像素被截斷：%2 個取樣中的 %1 個</translation>
    </message>
    <message>
        <source>not enough memory for the class fields</source>
        <translation>記憶體不足以容納類別的場</translation>
    </message>
    <message>
        <source>the most accurate that fits in memory</source>
        <translation>記憶體所能容納的最準確做法</translation>
    </message>
    <message>
        <source>there is no folder for temporary files</source>
        <translation>沒有暫存檔案的資料夾</translation>
    </message>
    <message>
        <source>the image does not match the header</source>
        <translation>影像與檔頭不符</translation>
    </message>
    <message>
        <source>has an image larger than DICOM allows</source>
        <translation>影像大於 DICOM 所允許</translation>
    </message>
    <message>
        <source>is listed in the DICOMDIR but missing</source>
        <translation>列於 DICOMDIR 但已遺失</translation>
    </message>
    <message>
        <source>the DICOM data dictionary is missing</source>
        <translation>缺少 DICOM 資料字典</translation>
    </message>
    <message>
        <source>the preset &apos;%1&apos; is made for %2, not for %3</source>
        <translation>預設集「%1」適用於 %2，不適用於 %3</translation>
    </message>
    <message>
        <source>is not a 3D Slicer volume property: %1</source>
        <translation>不是 3D Slicer 的體積屬性：%1</translation>
    </message>
    <message>
        <source>cannot be copied into the library: %1</source>
        <translation>無法複製到資料庫：%1</translation>
    </message>
    <message>
        <source>not enough memory for a basis field</source>
        <translation>記憶體不足以容納基底場</translation>
    </message>
    <message>
        <source>not enough memory to choose the kernel widths</source>
        <translation>記憶體不足以選擇核函數寬度</translation>
    </message>
    <message>
        <source>not enough memory for the lit field</source>
        <translation>記憶體不足以容納受光的場</translation>
    </message>
    <message>
        <source>is an index of files, not an image</source>
        <translation>是檔案索引，不是影像</translation>
    </message>
    <message>
        <source>unpacks to more than its stated size</source>
        <translation>解壓縮後大於其宣告的大小</translation>
    </message>
    <message>
        <source>not enough memory for the step &apos;%1&apos;</source>
        <translation>記憶體不足以執行步驟「%1」</translation>
    </message>
    <message>
        <source>the images have no pixel spacing</source>
        <translation>影像沒有像素間距</translation>
    </message>
    <message>
        <source>not enough memory for the volume</source>
        <translation>記憶體不足以容納此體積</translation>
    </message>
    <message>
        <source>there is another preset named &apos;%1&apos;</source>
        <translation>已有名為「%1」的預設集</translation>
    </message>
    <message>
        <source>refers to a file outside its folder</source>
        <translation>列出了資料夾之外的檔案</translation>
    </message>
    <message>
        <source>needs more memory than is available</source>
        <translation>需要的記憶體超過可用量</translation>
    </message>
    <message>
        <source>not enough memory to find edges</source>
        <translation>記憶體不足以尋找邊緣</translation>
    </message>
    <message>
        <source>the images have no orientation</source>
        <translation>影像沒有方向</translation>
    </message>
    <message>
        <source>is neither a file nor a folder</source>
        <translation>既非檔案也非資料夾</translation>
    </message>
    <message>
        <source>the softness must be 0 or more</source>
        <translation>柔和度必須大於或等於 0</translation>
    </message>
    <message>
        <source>not enough memory for %1 (%2 MB)</source>
        <translation>記憶體不足以容納 %2 MB 的%1</translation>
    </message>
    <message>
        <source>the step &apos;%1&apos; has no parameters</source>
        <translation>步驟「%1」沒有參數</translation>
    </message>
    <message>
        <source>the decoder cannot be set up</source>
        <translation>無法設定解碼器</translation>
    </message>
    <message>
        <source>the preset cannot be saved: %1</source>
        <translation>無法保存預設集：%1</translation>
    </message>
    <message>
        <source>the images have no position</source>
        <translation>影像沒有位置</translation>
    </message>
    <message>
        <source>its opacity is 0 everywhere</source>
        <translation>其不透明度處處為 0</translation>
    </message>
    <message>
        <source>the most accurate available</source>
        <translation>最準確的做法</translation>
    </message>
    <message>
        <source>the graphics card was lost</source>
        <translation>失去顯示卡</translation>
    </message>
    <message>
        <source>the NRRD header has no end</source>
        <translation>NRRD 檔頭沒有結尾</translation>
    </message>
    <message>
        <source>changed while it was being read</source>
        <translation>讀取期間有變動</translation>
    </message>
    <message>
        <source>has an image without rows or columns</source>
        <translation>影像沒有大小</translation>
    </message>
    <message>
        <source>the NRRD header has no &apos;%1&apos;</source>
        <translation>NRRD 檔頭缺少「%1」</translation>
    </message>
    <message>
        <source>No such file or directory</source>
        <translation>沒有此檔案或資料夾</translation>
    </message>
    <message>
        <source>the pixel data is truncated</source>
        <translation>像素被截斷</translation>
    </message>
    <message>
        <source>has the same instance UID as %1</source>
        <translation>與 %1 的實例 UID 相同</translation>
    </message>
    <message>
        <source>the scene is not valid: %1</source>
        <translation>場景無效：%1</translation>
    </message>
    <message>
        <source>the range %1 to %2 is empty</source>
        <translation>範圍 %1 至 %2 是空的</translation>
    </message>
    <message>
        <source>unknown step &apos;%1&apos;: use one of %2</source>
        <translation>步驟「%1」不在 %2 之中</translation>
    </message>
    <message>
        <source>No space left on device</source>
        <translation>磁碟空間不足</translation>
    </message>
    <message>
        <source>is a damaged archive: %1</source>
        <translation>為損壞的壓縮檔：%1</translation>
    </message>
    <message>
        <source>contains more than %1 files</source>
        <translation>含有超過 %1 個檔案</translation>
    </message>
    <message>
        <source>contains no usable images</source>
        <translation>沒有可用的影像</translation>
    </message>
    <message>
        <source>CPU engine, %1, %2 threads</source>
        <translation>CPU 引擎，%1，%2 執行緒</translation>
    </message>
    <message>
        <source>is a link to a folder</source>
        <translation>是資料夾的連結</translation>
    </message>
    <message>
        <source>no longer exists</source>
        <translation>已不存在</translation>
    </message>
    <message>
        <source>CPU engine, %1, %2 thread</source>
        <translation>CPU 引擎，%1，%2 執行緒</translation>
    </message>
    <message>
        <source>exact reference, double precision</source>
        <translation>精確參考，雙精度</translation>
    </message>
    <message>
        <source>ffmpeg cannot be started</source>
        <translation>無法啟動 ffmpeg</translation>
    </message>
    <message>
        <source>Read-only file system</source>
        <translation>檔案系統唯讀</translation>
    </message>
    <message>
        <source>is a damaged archive</source>
        <translation>為損壞的壓縮檔</translation>
    </message>
    <message>
        <source>damaged or truncated</source>
        <translation>損壞或被截斷</translation>
    </message>
    <message>
        <source>is a color image (%1)</source>
        <translation>是彩色影像 (%1)</translation>
    </message>
    <message>
        <source>the step &apos;%1&apos; failed: %2</source>
        <translation>步驟「%1」失敗：%2</translation>
    </message>
    <message>
        <source>cannot be encoded: %1</source>
        <translation>無法編碼：%1</translation>
    </message>
    <message>
        <source>cannot be removed: %1</source>
        <translation>無法移除：%1</translation>
    </message>
    <message>
        <source>cannot be written: %1</source>
        <translation>無法寫入：%1</translation>
    </message>
    <message>
        <source>the study library: %1</source>
        <translation>檢查資料庫：%1</translation>
    </message>
    <message>
        <source>is not a DICOM file</source>
        <translation>不是 DICOM 檔案</translation>
    </message>
    <message>
        <source>a class has no name</source>
        <translation>類別沒有名稱</translation>
    </message>
    <message>
        <source>is not a regular file</source>
        <translation>不是一般檔案</translation>
    </message>
    <message>
        <source>temporal position %1</source>
        <translation>時間點 %1</translation>
    </message>
    <message>
        <source>ffmpeg ended early</source>
        <translation>ffmpeg 提前結束</translation>
    </message>
    <message>
        <source>cannot be read: %1</source>
        <translation>無法讀取：%1</translation>
    </message>
    <message>
        <source>acquisition time %1</source>
        <translation>擷取時間 %1</translation>
    </message>
    <message>
        <source>Permission denied</source>
        <translation>沒有權限</translation>
    </message>
    <message>
        <source>not enough memory</source>
        <translation>記憶體不足</translation>
    </message>
    <message>
        <source>cannot be created: %1</source>
        <translation>無法建立：%1</translation>
    </message>
    <message>
        <source>has no pixel data (%1)</source>
        <translation>沒有像素 (%1)</translation>
    </message>
    <message>
        <source>is a broken link</source>
        <translation>是失效的連結</translation>
    </message>
    <message>
        <source>contains no images</source>
        <translation>沒有影像</translation>
    </message>
    <message>
        <source>damaged header</source>
        <translation>檔頭損壞</translation>
    </message>
    <message>
        <source>does not exist</source>
        <translation>不存在</translation>
    </message>
    <message>
        <source>Is a directory</source>
        <translation>是資料夾</translation>
    </message>
    <message>
        <source>images only: %1</source>
        <translation>僅有影像：%1</translation>
    </message>
    <message>
        <source>contains no data</source>
        <translation>沒有資料</translation>
    </message>
    <message>
        <source>has no pixel data</source>
        <translation>沒有像素</translation>
    </message>
    <message>
        <source>content time %1</source>
        <translation>內容時間 %1</translation>
    </message>
    <message>
        <source>is damaged: %1</source>
        <translation>已損壞：%1</translation>
    </message>
    <message>
        <source>is encrypted</source>
        <translation>已加密</translation>
    </message>
    <message>
        <source>acquisition %1</source>
        <translation>擷取 %1</translation>
    </message>
    <message>
        <source>GPU engine, %1</source>
        <translation>GPU 引擎，%1</translation>
    </message>
    <message>
        <source>is truncated</source>
        <translation>被截斷</translation>
    </message>
    <message>
        <source>JPEG 2000: %1</source>
        <translation>JPEG 2000：%1</translation>
    </message>
    <message>
        <source>%1 is not used: %2</source>
        <translation>未使用 %1：%2</translation>
    </message>
    <message>
        <source>class &apos;%1&apos;: %2</source>
        <translation>類別「%1」：%2</translation>
    </message>
    <message>
        <source>is empty</source>
        <translation>是空的</translation>
    </message>
    <message>
        <source>b-value %1</source>
        <translation>b 值 %1</translation>
    </message>
    <message>
        <source>line %1: %2</source>
        <translation>第 %1 行：%2</translation>
    </message>
    <message>
        <source>stack %1</source>
        <translation>堆疊 %1</translation>
    </message>
    <message>
        <source>echo %1</source>
        <translation>回波 %1</translation>
    </message>
    <message>
        <source>type %1</source>
        <translation>類型 %1</translation>
    </message>
    <message>
        <source>set %1</source>
        <translation>組 %1</translation>
    </message>
    <message>
        <source>OpenGL %1.%2 is too old; showing images needs 3.3</source>
        <translation>此處的 OpenGL 為 %1.%2；顯示影像需要 3.3</translation>
    </message>
    <message>
        <source>OpenGL contexts cannot share their objects</source>
        <translation>此處的 OpenGL 環境無法共用內容</translation>
    </message>
    <message>
        <source>a second OpenGL context cannot be created</source>
        <translation>此處的 OpenGL 無法提供第二個環境</translation>
    </message>
    <message>
        <source>OpenGL runs on a software renderer</source>
        <translation>此處的 OpenGL 為軟體繪圖</translation>
    </message>
    <message>
        <source>libEGL is not installed</source>
        <translation>此電腦沒有 libEGL</translation>
    </message>
    <message>
        <source>the graphics card was chosen</source>
        <translation>已選擇顯示卡</translation>
    </message>
    <message>
        <source>the processor was chosen</source>
        <translation>已選擇處理器</translation>
    </message>
    <message>
        <source>a graphics card was found</source>
        <translation>找到顯示卡</translation>
    </message>
    <message>
        <source>OpenGL is not available</source>
        <translation>此處沒有 OpenGL</translation>
    </message>
    <message>
        <source>copying needs a study library that can be written to</source>
        <translation>複製需要可寫入的檢查資料庫</translation>
    </message>
    <message>
        <source>has its samples in another file; not imported</source>
        <translation>取樣資料在另一個檔案；未匯入</translation>
    </message>
    <message>
        <source>the planes are not at right angles</source>
        <translation>各平面不互相垂直</translation>
    </message>
    <message>
        <source>was decoded to implausible data</source>
        <translation>解碼出的資料不合理</translation>
    </message>
    <message>
        <source>takes too long to read</source>
        <translation>讀取時間過長</translation>
    </message>
    <message>
        <source>needs %1 MB of memory, but only %2 MB are available</source>
        <translation>需要 %1 MB 記憶體，目前只有 %2 MB</translation>
    </message>
    <message>
        <source>the decoder cannot be started: %1</source>
        <translation>無法啟動解碼程式：%1</translation>
    </message>
    <message>
        <source>has sequences nested too deeply</source>
        <translation>序列巢狀層次過深</translation>
    </message>
    <message>
        <source>contains more files than it lists</source>
        <translation>內含的檔案多於其所宣告</translation>
    </message>
    <message>
        <source>is so damaged that the decoder crashed</source>
        <translation>損壞嚴重，解碼程式因此當掉</translation>
    </message>
    <message>
        <source>made the decoder attempt a forbidden system call</source>
        <translation>使解碼程式嘗試被禁止的系統呼叫</translation>
    </message>
    <message>
        <source>its sample file is missing: %1</source>
        <translation>缺少取樣檔：%1</translation>
    </message>
    <message>
        <source>%1 more</source>
        <translation>另有 %1 處</translation>
    </message>
    <message>
        <source>%1 mm between %2 and %3</source>
        <translation>%2 與 %3 之間 %1 mm</translation>
    </message>
    <message>
        <source>, </source>
        <translation>、</translation>
    </message>
    <message>
        <source>axial %1</source>
        <translation>橫斷面（第 %1 組）</translation>
    </message>
    <message>
        <source>coronal %1</source>
        <translation>冠狀面（第 %1 組）</translation>
    </message>
    <message>
        <source>sagittal %1</source>
        <translation>矢狀面（第 %1 組）</translation>
    </message>
    <message>
        <source>images %1</source>
        <translation>影像 %1</translation>
    </message>
    <message>
        <source>axial</source>
        <translation>橫斷面</translation>
    </message>
    <message>
        <source>coronal</source>
        <translation>冠狀面</translation>
    </message>
    <message>
        <source>sagittal</source>
        <translation>矢狀面</translation>
    </message>
    <message>
        <source>images</source>
        <translation>影像</translation>
    </message>
    <message>
        <source>%1 (%2 then %3 mm)</source>
        <translation>%1（先 %2 再 %3 mm）</translation>
    </message>
    <message>
        <source>is damaged</source>
        <translation>已損壞</translation>
    </message>
    <message>
        <source>is larger than the %1 MB limit for this kind of file</source>
        <translation>大於此類檔案的大小上限（%1 MB）</translation>
    </message>
    <message>
        <source>has an unusable rescale slope or intercept</source>
        <translation>重新調整斜率或截距無法得出數值</translation>
    </message>
    <message>
        <source>the file contains more samples than its header says</source>
        <translation>樣本數多於檔頭所述</translation>
    </message>
    <message>
        <source>samples that are not finite numbers: %1</source>
        <translation>非有限數值的樣本：%1</translation>
    </message>
    <message>
        <source>files with more pixels than their header says: %1</source>
        <translation>像素多於檔頭所述的檔案：%1</translation>
    </message>
    <message>
        <source>the NRRD header has &apos;%1&apos; twice</source>
        <translation>NRRD 檔頭中「%1」出現兩次</translation>
    </message>
    <message>
        <source>has too many data elements for an image</source>
        <translation>元素數量超過任何影像</translation>
    </message>
    <message>
        <source>its decoder was killed, perhaps because memory ran out</source>
        <translation>其解碼程式被終止，可能是記憶體不足</translation>
    </message>
    <message>
        <source>is not a folder</source>
        <translation>不是資料夾</translation>
    </message>
    <message>
        <source>the path is empty</source>
        <translation>路徑是空的</translation>
    </message>
    <message>
        <source>files with a rescale slope of 0, taken as 1: %1</source>
        <translation>重新調整斜率為 0、視為 1 的檔案：%1</translation>
    </message>
    <message>
        <source>the compressed pixel data is damaged: %1</source>
        <translation>壓縮的像素已損壞：%1</translation>
    </message>
    <message>
        <source>NRRD space units &apos;%1&apos; are not supported</source>
        <translation>不支援 NRRD 空間單位「%1」</translation>
    </message>
    <message>
        <source>is a link in an archive</source>
        <translation>是壓縮檔中的連結</translation>
    </message>
    <message>
        <source>already exists</source>
        <translation>已經存在</translation>
    </message>
    <message>
        <source>is not a session file</source>
        <translation>不是工作階段檔案</translation>
    </message>
    <message>
        <source>does not say whether its values are signed</source>
        <translation>未說明數值是否帶正負號</translation>
    </message>
    <message>
        <source>the file names no patient space; left-posterior-superior is assumed</source>
        <translation>未指明病患座標空間；視為左－後－上</translation>
    </message>
    <message>
        <source>NRRD units &apos;%1&apos; are not supported</source>
        <translation>不支援 NRRD 單位「%1」</translation>
    </message>
    <message>
        <source>files whose compressed pixel data is damaged: %1</source>
        <translation>壓縮像素損壞的檔案：%1</translation>
    </message>
    <message>
        <source>is damaged in the archive: %1</source>
        <translation>在壓縮檔中已損壞：%1</translation>
    </message>
    <message>
        <source>not enough memory to start the decoder</source>
        <translation>記憶體不足以啟動解碼程式</translation>
    </message>
    <message>
        <source>all slices have the same position</source>
        <translation>所有切片位於同一位置</translation>
    </message>
    <message>
        <source>%1 is %2 mm off the line through all slices</source>
        <translation>%1 偏離所有切片的連線 %2 mm</translation>
    </message>
    <message>
        <source>missing slices, interpolated: %1</source>
        <translation>缺少切片，已內插補上：%1</translation>
    </message>
    <message>
        <source>orientations differ by up to %1 degrees; the mean is used</source>
        <translation>切片方向最多相差 %1 度；採用平均值</translation>
    </message>
    <message>
        <source>pixel spacings differ by up to %1 %; the mean is used</source>
        <translation>像素間距最多相差 %1 %；採用平均值</translation>
    </message>
    <message>
        <source>almost every image has its own frame of reference; treated as one</source>
        <translation>幾乎每張影像各有自己的參考座標系；視為同一個</translation>
    </message>
    <message>
        <source>different images with the same instance UID: %1</source>
        <translation>不同影像具有相同的物件 UID：%1 張</translation>
    </message>
    <message>
        <source>the images of this series belong to %1 studies; shown in the first</source>
        <translation>同一系列的影像標示了 %1 個檢查；顯示於第一個</translation>
    </message>
    <message>
        <source>slices %1 to %2 of %3: a gap of %4 mm between %5 and %6</source>
        <translation>第 %1 至 %2 張，共 %3 張：%5 與 %6 之間有 %4 mm 的空隙</translation>
    </message>
    <message>
        <source>slice %1 of %2: a gap of %3 mm between %4 and %5</source>
        <translation>第 %1 張，共 %2 張：%4 與 %5 之間有 %3 mm 的空隙</translation>
    </message>
    <message>
        <source>files labeled explicit VR but encoded as implicit VR: %1</source>
        <translation>標示為顯式、實際為隱式編碼的檔案：%1</translation>
    </message>
    <message>
        <source>files with a compressed transfer syntax but pixel data of defined length: %1</source>
        <translation>壓縮語法卻具有固定長度像素的檔案：%1</translation>
    </message>
    <message>
        <source>files whose compressed pixel data is not terminated: %1</source>
        <translation>壓縮像素沒有結尾的檔案：%1</translation>
    </message>
    <message>
        <source>files whose pixels have more bits than their header says: %1</source>
        <translation>像素位元數多於檔頭所述的檔案：%1</translation>
    </message>
    <message>
        <source>mosaics that could not be split into slices, shown as single images: %1</source>
        <translation>無法拆開而以平面顯示的拼接影像：%1</translation>
    </message>
    <message>
        <source>is unusually large: %1 x %2 x %3 pixels in a file of %4 MB</source>
        <translation>異常龐大：%4 MB 的檔案內有 %1 x %2 x %3 像素</translation>
    </message>
    <message>
        <source>has an unsupported transfer syntax: %1</source>
        <translation>不支援的傳輸語法：%1</translation>
    </message>
    <message>
        <source>has %1 samples per pixel; monochrome images have one</source>
        <translation>每像素有 %1 個取樣；單色影像只有一個</translation>
    </message>
    <message>
        <source>the pixel data cannot be read</source>
        <translation>無法讀取像素</translation>
    </message>
    <message>
        <source>a compressed frame has no header</source>
        <translation>壓縮影格沒有檔頭</translation>
    </message>
    <message>
        <source>a compressed frame has %1 x %2 pixels, but the header says %3 x %4</source>
        <translation>壓縮影格有 %1 x %2 像素，檔頭則為 %3 x %4</translation>
    </message>
    <message>
        <source>a compressed frame has %1 color components</source>
        <translation>壓縮影格有 %1 個色彩分量</translation>
    </message>
    <message>
        <source>a compressed frame has %1 bits per sample, but the header says %2</source>
        <translation>壓縮影格每取樣 %1 位元，檔頭則為 %2</translation>
    </message>
    <message>
        <source>a compressed frame does not match its transfer syntax (marker %1): %2</source>
        <translation>壓縮影格的編碼（標記 %1）與其傳輸語法不符：%2</translation>
    </message>
    <message>
        <source>the compressed pixel data has no fragments: %1</source>
        <translation>壓縮像素沒有分段：%1</translation>
    </message>
    <message>
        <source>a run-length frame has no header</source>
        <translation>遊程編碼影格沒有檔頭</translation>
    </message>
    <message>
        <source>a run-length frame has wrong offsets</source>
        <translation>遊程編碼影格的位移有誤</translation>
    </message>
    <message>
        <source>JPEG XL: %1</source>
        <translation>JPEG XL：%1</translation>
    </message>
    <message>
        <source>contains no image</source>
        <translation>不含影像</translation>
    </message>
    <message>
        <source>slices %1 to %2</source>
        <translation>第 %1 至 %2 張</translation>
    </message>
    <message>
        <source>slice %1</source>
        <translation>第 %1 張</translation>
    </message>
    <message>
        <source>gaps filled</source>
        <translation>已補上空隙</translation>
    </message>
    <message>
        <source>many files</source>
        <translation>許多檔案</translation>
    </message>
    <message>
        <source>is not a NRRD, NIfTI or MetaImage file</source>
        <translation>不是 NRRD、NIfTI 或 MetaImage 檔案</translation>
    </message>
    <message>
        <source>the size of the volume is out of range</source>
        <translation>體積的大小超出範圍</translation>
    </message>
    <message>
        <source>the volume is too large</source>
        <translation>體積過大</translation>
    </message>
    <message>
        <source>the origin is more than a kilometer away</source>
        <translation>原點距離超過一公里</translation>
    </message>
    <message>
        <source>the sample spacing is less than a nanometer or more than ten metres</source>
        <translation>取樣間距小於一奈米或大於十公尺</translation>
    </message>
    <message>
        <source>contains colors; only one value per voxel is supported</source>
        <translation>含有色彩；僅支援每體素一個值的體積</translation>
    </message>
    <message>
        <source>has several values per voxel; only one is supported</source>
        <translation>每體素含有多個值；僅支援單一值的體積</translation>
    </message>
    <message>
        <source>contains too many volumes</source>
        <translation>所含體積過多</translation>
    </message>
    <message>
        <source>contains fewer volumes than before</source>
        <translation>所含體積比先前少</translation>
    </message>
    <message>
        <source>NIfTI data type %1 is not supported</source>
        <translation>不支援 NIfTI 資料型別 %1</translation>
    </message>
    <message>
        <source>the NIfTI header has no valid dimensions</source>
        <translation>NIfTI 檔頭沒有維度</translation>
    </message>
    <message>
        <source>the NIfTI header does not say where the samples are</source>
        <translation>NIfTI 檔頭未說明取樣的位置</translation>
    </message>
    <message>
        <source>has its samples in another file; only single-file NIfTI (.nii) is supported</source>
        <translation>取樣在另一個檔案中；僅支援單一檔案的 NIfTI (.nii)</translation>
    </message>
    <message>
        <source>the MetaImage header has a line without &apos;=&apos;</source>
        <translation>MetaImage 檔頭有一行沒有「=」</translation>
    </message>
    <message>
        <source>the MetaImage header has no &apos;%1&apos;</source>
        <translation>MetaImage 檔頭沒有「%1」</translation>
    </message>
    <message>
        <source>the MetaImage header has &apos;%1&apos; where numbers are expected</source>
        <translation>MetaImage 檔頭中應為數字之處是「%1」</translation>
    </message>
    <message>
        <source>MetaImage type &apos;%1&apos; is not supported</source>
        <translation>不支援 MetaImage 型別「%1」</translation>
    </message>
    <message>
        <source>only three- and four-dimensional MetaImage volumes are supported</source>
        <translation>僅支援三維與四維的 MetaImage 體積</translation>
    </message>
    <message>
        <source>MetaImage samples as text are not supported</source>
        <translation>不支援文字形式的 MetaImage 取樣</translation>
    </message>
    <message>
        <source>MetaImage samples in a list of files are not supported</source>
        <translation>不支援分散於多個檔案的 MetaImage 取樣</translation>
    </message>
    <message>
        <source>a negative MetaImage HeaderSize is not supported</source>
        <translation>不支援負的 MetaImage HeaderSize</translation>
    </message>
    <message>
        <source>its values, from %1 to %2, are too close together for single precision</source>
        <translation>其值自 %1 至 %2，彼此過於接近，單精度無法分辨</translation>
    </message>
    <message>
        <source>values that differ by less than %1 are shown as equal</source>
        <translation>差異小於 %1 的數值顯示為相等</translation>
    </message>
    <message>
        <source>nothing is visible, so there is no spectrum to show</source>
        <translation>沒有可見的內容，因此沒有頻譜可顯示</translation>
    </message>
    <message>
        <source>; </source>
        <translation>；</translation>
    </message>
    <message>
        <source>%1</source>
        <translation>%1</translation>
    </message>
    <message>
        <source>Operation not permitted</source>
        <translation>不允許此操作</translation>
    </message>
    <message>
        <source>Disk quota exceeded</source>
        <translation>超過磁碟配額</translation>
    </message>
    <message>
        <source>Not a directory</source>
        <translation>不是資料夾</translation>
    </message>
    <message>
        <source>File name too long</source>
        <translation>檔名過長</translation>
    </message>
    <message>
        <source>Too many open files</source>
        <translation>開啟的檔案過多</translation>
    </message>
    <message>
        <source>Input/output error</source>
        <translation>輸入或輸出錯誤</translation>
    </message>
    <message>
        <source>File too large</source>
        <translation>檔案過大</translation>
    </message>
    <message>
        <source>Too many levels of symbolic links</source>
        <translation>符號連結層次過多</translation>
    </message>
    <message>
        <source>the system reports: %1</source>
        <translation>系統回報：%1</translation>
    </message>
    <message>
        <source>is not in a folder</source>
        <translation>不在資料夾中</translation>
    </message>
    <message>
        <source>the volume has no samples along one axis</source>
        <translation>體積有一軸沒有取樣</translation>
    </message>
    <message>
        <source>the volume has more samples than any machine can hold</source>
        <translation>體積的取樣數超過任何電腦所能容納</translation>
    </message>
    <message>
        <source>the geometry has numbers that are not finite</source>
        <translation>幾何資料不是有限的數值</translation>
    </message>
    <message>
        <source>the voxel axes do not span a volume</source>
        <translation>體素的步距未構成體積</translation>
    </message>
    <message>
        <source>several series have the number &apos;%1&apos;; choose one by UID: %2</source>
        <translation>有數個序列的編號為「%1」；請以 UID 選擇：%2</translation>
    </message>
    <message>
        <source>there is no series &apos;%1&apos;; available: %2</source>
        <translation>沒有序列「%1」；現有 %2</translation>
    </message>
    <message>
        <source>series %2 has no volume %1; it has only one</source>
        <translation>序列 %2 中沒有體積 %1；只有一個</translation>
    </message>
    <message>
        <source>series %2 has no volume %1; it has %3</source>
        <translation>序列 %2 中沒有體積 %1；共有 %3 個</translation>
    </message>
    <message>
        <source>%1; the other slices do not form a volume</source>
        <translation>%1；其餘切片不構成體積</translation>
    </message>
    <message>
        <source>file %1</source>
        <translation>檔案 %1</translation>
    </message>
    <message>
        <source>attribute (%1) cannot be set</source>
        <translation>無法設定屬性 (%1)</translation>
    </message>
    <message>
        <source>the code of the confidentiality profile cannot be written</source>
        <translation>無法寫入保密規範的代碼</translation>
    </message>
    <message>
        <source>compression failed: %1</source>
        <translation>壓縮失敗：%1</translation>
    </message>
    <message>
        <source>unknown transfer syntax &apos;%1&apos;: use one of %2</source>
        <translation>未知的傳輸語法「%1」；已知者為 %2</translation>
    </message>
    <message>
        <source>only volumes with whole HU values can be written as CT</source>
        <translation>只有數值為整數 HU 的體積能寫成 CT</translation>
    </message>
    <message>
        <source>an internal error occurred; the log has the details</source>
        <translation>程式發生錯誤；記錄檔中有詳情</translation>
    </message>
    <message>
        <source>%1 belongs to an open study; choose another name</source>
        <translation>%1 是已開啟檢查的檔案；請選擇其他名稱</translation>
    </message>
    <message>
        <source>a look needs a name</source>
        <translation>外觀需要名稱</translation>
    </message>
    <message>
        <source>there is no projection yet</source>
        <translation>尚無投影</translation>
    </message>
    <message>
        <source>the look needs %1 MB of memory, more than is available</source>
        <translation>此外觀需要 %1 MB 記憶體，超過可用量</translation>
    </message>
    <message>
        <source>not enough memory to copy to the graphics card</source>
        <translation>記憶體不足，無法複製到顯示卡</translation>
    </message>
    <message>
        <source>the copy to the graphics card was cancelled</source>
        <translation>已取消複製到顯示卡</translation>
    </message>
    <message>
        <source>a first, coarse picture</source>
        <translation>第一張粗略影像</translation>
    </message>
    <message>
        <source>not on the graphics card yet</source>
        <translation>尚未送達顯示卡</translation>
    </message>
    <message>
        <source>the graphics card is being prepared</source>
        <translation>正在準備顯示卡</translation>
    </message>
    <message>
        <source>the study library is damaged: %1</source>
        <translation>檢查資料庫已損壞：%1</translation>
    </message>
    <message>
        <source>the study library was damaged and nothing could be recovered; the old file is kept under this name</source>
        <translation>檢查資料庫已損毀，且無法讀取任何內容；舊檔以此名稱保留</translation>
    </message>
    <message>
        <source>the study library was empty; its copied studies are listed again</source>
        <translation>檢查資料庫是空的；其自有的複本將重新列出</translation>
    </message>
    <message>
        <source>is damaged, and a new one cannot be written: %1</source>
        <translation>已損毀，且無法寫入新的清單：%1</translation>
    </message>
    <message>
        <source>your data folder cannot be written to; nothing is saved, and studies are listed only until the program closes</source>
        <translation>您的資料夾無法寫入；不會保存任何內容，檢查僅列出至程式關閉為止</translation>
    </message>
    <message>
        <source>the copies need %1 MB, but only %2 MB are free</source>
        <translation>複製需要 %1 MB，只有 %2 MB 可用</translation>
    </message>
    <message>
        <source>the files of this volume have changed; import them again</source>
        <translation>此體積的檔案已變動；請重新匯入</translation>
    </message>
    <message>
        <source>the files of this series cannot be found; the disc or drive they are on may be disconnected</source>
        <translation>找不到此序列的檔案；其光碟或磁碟可能已移除</translation>
    </message>
    <message>
        <source>The measurements of this study cannot be read: %1</source>
        <translation>無法讀取此檢查的測量：%1</translation>
    </message>
    <message>
        <source>The measurements cannot be saved: %1</source>
        <translation>無法保存測量：%1</translation>
    </message>
    <message>
        <source>The measurements cannot be saved: there is no folder for them</source>
        <translation>無法保存測量：沒有可用的資料夾</translation>
    </message>
    <message>
        <source>the earlier ones cannot be read and would be lost</source>
        <translation>無法讀取先前的測量，儲存會使其遺失</translation>
    </message>
    <message>
        <source>The projection is still being computed</source>
        <translation>投影仍在製作中</translation>
    </message>
    <message>
        <source>Only the projection can be exported as values</source>
        <translation>只有投影能輸出數值</translation>
    </message>
    <message>
        <source>Only the projection can be exported as a turntable</source>
        <translation>只有投影能匯出為環繞一周</translation>
    </message>
    <message>
        <source>Videos need ffmpeg, which is not installed; export frames instead</source>
        <translation>影片需要 ffmpeg，但未安裝；請改為匯出逐格影像</translation>
    </message>
    <message>
        <source>A picture in color has no grey values: export it as it looks, or as NumPy values</source>
        <translation>彩色影像沒有灰階數值：請以所見或 NumPy 格式寫出</translation>
    </message>
    <message>
        <source>Pictures can have at most %1 pixels a side</source>
        <translation>影像每邊最多 %1 像素</translation>
    </message>
    <message>
        <source>ffmpeg: %1</source>
        <translation>ffmpeg：%1</translation>
    </message>
    <message>
        <source>cannot be written</source>
        <translation>無法寫入</translation>
    </message>
    <message>
        <source>the decoder has exited</source>
        <translation>解碼程式已不存在</translation>
    </message>
    <message>
        <source>it does not respond</source>
        <translation>沒有回應</translation>
    </message>
    <message>
        <source>cannot be mapped: %1</source>
        <translation>無法對映：%1</translation>
    </message>
    <message>
        <source>was requested in a way that the decoder does not support</source>
        <translation>要求的方式為解碼程式所不認識</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>truncated</source>
        <translation>被截斷</translation>
    </message>
    <message>
        <source>JPEG 2000 encoding failed</source>
        <translation>JPEG 2000 編碼失敗</translation>
    </message>
    <message>
        <source>is not a NRRD file</source>
        <translation>不是 NRRD 檔案</translation>
    </message>
    <message>
        <source>the NRRD header has a line without a colon</source>
        <translation>NRRD 檔頭有一行沒有冒號</translation>
    </message>
    <message>
        <source>the NRRD header has &apos;%1&apos; where numbers are expected</source>
        <translation>NRRD 檔頭中應為數字之處是「%1」</translation>
    </message>
    <message>
        <source>NRRD space &apos;%1&apos; is not supported</source>
        <translation>不支援 NRRD 空間「%1」</translation>
    </message>
    <message>
        <source>the NRRD vector has no closing bracket: %1</source>
        <translation>NRRD 向量沒有結尾：%1</translation>
    </message>
    <message>
        <source>the NRRD header must have three space directions</source>
        <translation>應有三個 NRRD 空間方向</translation>
    </message>
    <message>
        <source>the NRRD header must have one space origin</source>
        <translation>應有一個 NRRD 空間原點</translation>
    </message>
    <message>
        <source>NRRD type &apos;%1&apos; is not supported</source>
        <translation>不支援 NRRD 型別「%1」</translation>
    </message>
    <message>
        <source>NRRD encoding &apos;%1&apos; is not supported</source>
        <translation>不支援 NRRD 編碼「%1」</translation>
    </message>
    <message>
        <source>NRRD endian &apos;%1&apos; is not supported</source>
        <translation>不支援 NRRD 位元組順序「%1」</translation>
    </message>
    <message>
        <source>the NRRD field &apos;%1&apos; is not supported</source>
        <translation>不支援 NRRD「%1」</translation>
    </message>
    <message>
        <source>is not a NIfTI file</source>
        <translation>不是 NIfTI 檔案</translation>
    </message>
    <message>
        <source>must be a number</source>
        <translation>必須是數字</translation>
    </message>
    <message>
        <source>must be a list of numbers</source>
        <translation>必須是數字清單</translation>
    </message>
    <message>
        <source>must be two numbers</source>
        <translation>必須是兩個數字</translation>
    </message>
    <message>
        <source>must be two numbers, the lower first</source>
        <translation>必須是兩個數字，較小者在前</translation>
    </message>
    <message>
        <source>must be three numbers</source>
        <translation>必須是三個數字</translation>
    </message>
    <message>
        <source>must be text</source>
        <translation>必須是文字</translation>
    </message>
    <message>
        <source>must be one line of 1 to %1 characters</source>
        <translation>必須是一行 1 至 %1 個字元的文字</translation>
    </message>
    <message>
        <source>must be a list</source>
        <translation>必須是清單</translation>
    </message>
    <message>
        <source>must be an object</source>
        <translation>必須是物件</translation>
    </message>
    <message>
        <source>must be value or window</source>
        <translation>必須是 value 或 window</translation>
    </message>
    <message>
        <source>is out of range</source>
        <translation>超出範圍</translation>
    </message>
    <message>
        <source>is not %1</source>
        <translation>不是 %1</translation>
    </message>
    <message>
        <source>unknown value &apos;%1&apos;: use one of %2</source>
        <translation>「%1」不在 %2 之中</translation>
    </message>
    <message>
        <source>has no %1</source>
        <translation>缺少 %1</translation>
    </message>
    <message>
        <source>not enough memory for a field of %1 x %2 x %3</source>
        <translation>記憶體不足以容納 %1 x %2 x %3 的場</translation>
    </message>
    <message>
        <source>not enough memory for a phantom of this size</source>
        <translation>記憶體不足以容納此大小的假體</translation>
    </message>
    <message>
        <source>not enough memory for the exact reference</source>
        <translation>記憶體不足以計算精確參考影像</translation>
    </message>
    <message>
        <source>not enough memory for the exact shaded field</source>
        <translation>記憶體不足以容納精確的明暗場</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not a color of the form #rrggbb</source>
        <translation>「%1」不是 #rrggbb 形式的色彩</translation>
    </message>
    <message>
        <source>the color components must be between 0 and 1</source>
        <translation>色彩分量必須在 0 與 1 之間</translation>
    </message>
    <message>
        <source>the weight %1 is not between 0 and %2</source>
        <translation>權重 %1 不在 0 與 %2 之間</translation>
    </message>
    <message>
        <source>has %1 steps; at most %2 are allowed</source>
        <translation>有 %1 個步驟，允許 %2 個</translation>
    </message>
    <message>
        <source>there are %1 classes; at most %2 are allowed</source>
        <translation>有 %1 個類別，允許 %2 個</translation>
    </message>
    <message>
        <source>the step &apos;%1&apos; must come before &apos;%2&apos;</source>
        <translation>步驟「%1」必須在「%2」之前</translation>
    </message>
    <message>
        <source>the steps of the class &apos;%1&apos; cannot be run here</source>
        <translation>此處無法執行類別「%1」的步驟</translation>
    </message>
    <message>
        <source>%1 of the step &apos;%2&apos; is %3, not between %4 and %5</source>
        <translation>步驟「%2」的 %1 為 %3，不在 %4 與 %5 之間</translation>
    </message>
    <message>
        <source>%1 of the step &apos;%2&apos; is %3, not a whole number</source>
        <translation>步驟「%2」的 %1 為 %3，不是整數</translation>
    </message>
    <message>
        <source>low is above high in the step &apos;%1&apos;</source>
        <translation>步驟「%1」的 low 高於 high</translation>
    </message>
    <message>
        <source>edges by ITK need at least four samples along each axis; the fast method does not</source>
        <translation>以 ITK 求邊緣時，每軸至少需要四個取樣；快速方法則不需要</translation>
    </message>
    <message>
        <source>edges by ITK need a sigma_mm above 0</source>
        <translation>以 ITK 求邊緣時，sigma_mm 必須大於 0</translation>
    </message>
    <message>
        <source>the crop box needs 0 &lt;= low &lt; high &lt;= 1 on every axis</source>
        <translation>裁切框的每一軸都必須符合 0 &lt;= 低 &lt; 高 &lt;= 1</translation>
    </message>
    <message>
        <source>there is no preset &apos;%1&apos;; &apos;pellucid-cli preset list&apos; lists the presets</source>
        <translation>沒有預設集「%1」；以 pellucid-cli preset list 可列出</translation>
    </message>
    <message>
        <source>there is no preset &apos;%1&apos;; similar names: %2</source>
        <translation>沒有預設集「%1」；名稱相近的有 %2</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is built in and cannot be removed</source>
        <translation>「%1」為程式內建，不能移除</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is built in and cannot be replaced; choose another name</source>
        <translation>「%1」為程式內建，不能變更；請選擇其他名稱</translation>
    </message>
    <message>
        <source>the file ends before its scalar opacity</source>
        <translation>檔案在純量不透明度之前結束</translation>
    </message>
    <message>
        <source>the scalar opacity does not begin with the number of its values</source>
        <translation>純量不透明度並非以數值個數開頭</translation>
    </message>
    <message>
        <source>%1 values are declared, but only %2 are present</source>
        <translation>宣告 %1 個數值，只有 %2 個</translation>
    </message>
    <message>
        <source>the value %1 is out of range</source>
        <translation>數值 %1 超出範圍</translation>
    </message>
    <message>
        <source>the opacity %1 at %2 is not between 0 and 1</source>
        <translation>%2 處的不透明度 %1 不在 0 與 1 之間</translation>
    </message>
    <message>
        <source>its opacity does not change over any range of values</source>
        <translation>其不透明度在任何數值範圍內都不變</translation>
    </message>
    <message>
        <source>%1: &apos;%2&apos; is not a number</source>
        <translation>%1：「%2」不是數字</translation>
    </message>
    <message>
        <source>the depth cue &apos;%1&apos;</source>
        <translation>深度提示「%1」</translation>
    </message>
    <message>
        <source>the light &apos;%1&apos;</source>
        <translation>光源「%1」</translation>
    </message>
    <message>
        <source>unknown depth cue &apos;%1&apos;: use none, linear:S, sine:S or curve:c0,c1,...</source>
        <translation>深度提示「%1」不是 none、linear:S、sine:S 或 curve:c0,c1,...</translation>
    </message>
    <message>
        <source>the light &apos;%1&apos; is not of the form u,v,w[:#rrggbb[:S]]</source>
        <translation>光源「%1」不是 u,v,w[:#rrggbb[:S]]</translation>
    </message>
    <message>
        <source>the strength of the depth cue must be between 0 and 1</source>
        <translation>深度提示的強度必須在 0 至 1 之間</translation>
    </message>
    <message>
        <source>the curve of the depth cue must have %1 to %2 values</source>
        <translation>深度提示的曲線必須有 %1 至 %2 個數值</translation>
    </message>
    <message>
        <source>the values of the depth cue&apos;s curve must be between 0 and %1</source>
        <translation>深度提示曲線的數值必須在 0 至 %1 之間</translation>
    </message>
    <message>
        <source>the ambient light must be between 0 and %1</source>
        <translation>環境光必須在 0 至 %1 之間</translation>
    </message>
    <message>
        <source>at most %1 lights are allowed</source>
        <translation>最多允許 %1 個光源</translation>
    </message>
    <message>
        <source>the direction of a light must be finite and not zero</source>
        <translation>光源的方向不可為 0，亦不可超出數值範圍</translation>
    </message>
    <message>
        <source>the strength of a light must be between 0 and 1</source>
        <translation>光源的強度必須在 0 至 1 之間</translation>
    </message>
    <message>
        <source>the color components of a light must be between 0 and 1</source>
        <translation>光源的色彩分量必須在 0 與 1 之間</translation>
    </message>
    <message>
        <source>the image size must be 1 to %1 pixels a side</source>
        <translation>影像每邊必須為 1 至 %1 像素</translation>
    </message>
    <message>
        <source>the pixel size must be positive</source>
        <translation>像素必須是正的長度</translation>
    </message>
    <message>
        <source>the pan must be finite</source>
        <translation>平移必須是有限的數值</translation>
    </message>
    <message>
        <source>the orientation must not be zero</source>
        <translation>方向不可為零</translation>
    </message>
    <message>
        <source>the roll-off must be between 0 and 1</source>
        <translation>滾降必須在 0 至 1 之間</translation>
    </message>
    <message>
        <source>the tolerance must be positive</source>
        <translation>容差必須大於 0</translation>
    </message>
    <message>
        <source>the padding must be between 1 and 4</source>
        <translation>補零必須在 1 至 4 之間</translation>
    </message>
    <message>
        <source>the window&apos;s low end must be below its high end</source>
        <translation>窗的下限必須低於上限</translation>
    </message>
    <message>
        <source>unknown kernel &apos;%1&apos;: use nearest, trilinear, catmull-rom, b-spline, hamming-sinc, ES2 to ES7, KB2 to KB7 or LS2 to LS7</source>
        <translation>「%1」不是核函數；現有 nearest、trilinear、catmull-rom、b-spline、hamming-sinc、ES2 至 ES7、KB2 至 KB7 與 LS2 至 LS7</translation>
    </message>
    <message>
        <source>unknown storage &apos;%1&apos;: use f16 or f32</source>
        <translation>「%1」不是儲存格式；現有 f16 與 f32</translation>
    </message>
    <message>
        <source>pixels of %1 mm at a pan of %2 mm need a slice of more than %3 frequencies a side</source>
        <translation>像素 %1 mm、偏離中心 %2 mm，需要每邊超過 %3 個頻率的切片</translation>
    </message>
    <message>
        <source>the projection needs more cells than an engine can count</source>
        <translation>投影所需的格數超過引擎所能計數</translation>
    </message>
    <message>
        <source>libOpenGL is not installed</source>
        <translation>此電腦沒有 libOpenGL</translation>
    </message>
    <message>
        <source>the graphics driver cannot create an OpenGL 3.3 context</source>
        <translation>顯示驅動程式無法建立 OpenGL 3.3 環境</translation>
    </message>
    <message>
        <source>EGL finds no device</source>
        <translation>EGL 在此找不到裝置</translation>
    </message>
    <message>
        <source>no graphics card was found</source>
        <translation>找不到顯示卡</translation>
    </message>
    <message>
        <source>the OpenGL context cannot be used</source>
        <translation>無法使用 OpenGL 環境</translation>
    </message>
    <message>
        <source>OpenGL %1.%2 (%3) is too old; the GPU engine needs 4.3</source>
        <translation>此處的 OpenGL 為 %1.%2（%3）；GPU 引擎需要 4.3</translation>
    </message>
    <message>
        <source>OpenGL error %1 (%2)</source>
        <translation>OpenGL 錯誤 %1：%2</translation>
    </message>
    <message>
        <source>shader %1: %2</source>
        <translation>著色器 %1：%2</translation>
    </message>
    <message>
        <source>%1 spectra in %2 textures are more than the graphics card can read at once</source>
        <translation>%2 個紋理中的 %1 個頻譜，超過顯示卡一次所能讀取</translation>
    </message>
    <message>
        <source>the slice of this image, %1 x %2 cells, needs %3 MB in one piece; the graphics card allows %4 MB (larger pixels need fewer cells)</source>
        <translation>此影像的切片有 %1 x %2 格，需要連續的 %3 MB；顯示卡提供 %4 MB（像素較大則所需格數較少）</translation>
    </message>
    <message>
        <source>an image of %1 x %2 pixels is larger than the graphics card&apos;s largest texture, %3 x %3</source>
        <translation>%1 x %2 像素的影像大於顯示卡的紋理，最大為 %3 x %3</translation>
    </message>
    <message>
        <source>unknown phantom &apos;%1&apos;: use one of %2</source>
        <translation>未知的假體「%1」；已知者為 %2</translation>
    </message>
    <message>
        <source>the tilt must be between -57 and 57 degrees</source>
        <translation>傾斜必須在 -57 至 57 度之間</translation>
    </message>
    <message>
        <source>phantom sizes must be 1 to 4096 and spacings positive</source>
        <translation>假體的大小必須為 1 至 4096，間距必須大於 0</translation>
    </message>
    <message>
        <source>measurement %1: %2</source>
        <translation>測量 %1：%2</translation>
    </message>
    <message>
        <source>is not a list of measurements (%1)</source>
        <translation>不是測量清單（%1）</translation>
    </message>
    <message>
        <source>it must have %1 points</source>
        <translation>必須有 %1 個點</translation>
    </message>
    <message>
        <source>its directions are not at right angles</source>
        <translation>其方向不互相垂直</translation>
    </message>
    <message>
        <source>a row</source>
        <translation>一列</translation>
    </message>
    <message>
        <source>a transform&apos;s rows</source>
        <translation>轉換的各列</translation>
    </message>
    <message>
        <source>a transform</source>
        <translation>轉換</translation>
    </message>
    <message>
        <source>a spectrum</source>
        <translation>頻譜</translation>
    </message>
    <message>
        <source>an image of this size</source>
        <translation>此大小的影像</translation>
    </message>
    <message>
        <source>the preset &apos;%1&apos; is made for Hounsfield units, but the values may not be in HU</source>
        <translation>預設集「%1」適用於 Hounsfield 單位，而數值不確定是此單位</translation>
    </message>
    <message>
        <source>kernel</source>
        <translation>核函數</translation>
    </message>
    <message>
        <source>padding</source>
        <translation>補零</translation>
    </message>
    <message>
        <source>storage</source>
        <translation>儲存</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1、%2</translation>
    </message>
    <message>
        <source>must be four numbers</source>
        <translation>必須是四個數字</translation>
    </message>
    <message>
        <source>must be true or false</source>
        <translation>必須是 true 或 false</translation>
    </message>
    <message>
        <source>is a segmentation, which is shown with the images that it belongs to</source>
        <translation>是分割檔，會與所屬的影像一起顯示</translation>
    </message>
    <message>
        <source>is not a segmentation</source>
        <translation>不是分割檔</translation>
    </message>
    <message>
        <source>describes no segments</source>
        <translation>沒有描述任何分割區</translation>
    </message>
    <message>
        <source>describes more than %1 segments</source>
        <translation>描述了超過 %1 個分割區</translation>
    </message>
    <message>
        <source>describes segment %1 twice</source>
        <translation>重複描述分割區 %1</translation>
    </message>
    <message>
        <source>has a segment number outside 1 to 65535</source>
        <translation>有分割區編號不在 1 至 65535 之間</translation>
    </message>
    <message>
        <source>has a frame of segment %1, which it does not describe</source>
        <translation>有一格屬於未描述的分割區 %1</translation>
    </message>
    <message>
        <source>has a frame without a position, an orientation or a pixel spacing</source>
        <translation>有一格沒有位置、方向或像素間距</translation>
    </message>
    <message>
        <source>has an unknown segmentation type: &apos;%1&apos;</source>
        <translation>分割類型不明：「%1」</translation>
    </message>
    <message>
        <source>has compressed one-bit pixels, which are not supported</source>
        <translation>有壓縮的單位元像素，不支援</translation>
    </message>
    <message>
        <source>has %1 bits per pixel instead of %2</source>
        <translation>每像素 %1 位元，應為 %2</translation>
    </message>
    <message>
        <source>has a maximum fractional value outside 1 to 65535</source>
        <translation>最大分數值不在 1 至 65535 之間</translation>
    </message>
    <message>
        <source>has two structures with the number %1</source>
        <translation>有兩個結構的編號都是 %1</translation>
    </message>
    <message>
        <source>has contours of structure %1, which it does not describe</source>
        <translation>有輪廓屬於未描述的結構 %1</translation>
    </message>
    <message>
        <source>has a contour with damaged coordinates: structure &apos;%1&apos;</source>
        <translation>有輪廓的座標已損壞：結構「%1」</translation>
    </message>
    <message>
        <source>has no closed contours</source>
        <translation>沒有封閉的輪廓</translation>
    </message>
    <message>
        <source>has more than %1 contour points</source>
        <translation>輪廓點超過 %1 個</translation>
    </message>
    <message>
        <source>has contours that are not in parallel planes</source>
        <translation>有輪廓不在平行的平面上</translation>
    </message>
    <message>
        <source>has contours larger than any image</source>
        <translation>有輪廓大於任何影像</translation>
    </message>
    <message>
        <source>has frames that are not parallel</source>
        <translation>有互不平行的格</translation>
    </message>
    <message>
        <source>belongs to another study</source>
        <translation>屬於另一個檢查</translation>
    </message>
    <message>
        <source>has no segment within the volume</source>
        <translation>沒有任何分割區在此體積之內</translation>
    </message>
    <message>
        <source>open contours and points, which enclose nothing: %1</source>
        <translation>未圍住任何範圍的開放輪廓與點：%1</translation>
    </message>
    <message>
        <source>the soft edge of %1 samples is outside 0 to %2</source>
        <translation>柔邊 %1 個取樣不在 0 至 %2 之間</translation>
    </message>
    <message>
        <source>the segmentation cannot be written: %1</source>
        <translation>無法寫入分割檔：%1</translation>
    </message>
    <message>
        <source>the segments &apos;%1&apos; and &apos;%2&apos; overlap, which labels cannot express; write a DICOM segmentation</source>
        <translation>分割區「%1」與「%2」重疊，標籤無法表示；請寫成 DICOM 分割檔</translation>
    </message>
    <message>
        <source>no value at the points to grow from is within the range</source>
        <translation>起始點的值都不在範圍之內</translation>
    </message>
    <message>
        <source>the points to grow from are in places narrower than the leak limit</source>
        <translation>起始點所在之處比洩漏限制更窄</translation>
    </message>
    <message>
        <source>needs segments that are not loaded: %1</source>
        <translation>需要尚未載入的分割區：%1</translation>
    </message>
    <message>
        <source>the class &apos;%1&apos; needs the segment &apos;%2&apos;, which is not loaded</source>
        <translation>類別「%1」需要尚未載入的分割區「%2」</translation>
    </message>
    <message>
        <source>not enough memory for the segments</source>
        <translation>記憶體不足以容納分割區</translation>
    </message>
    <message>
        <source>has a different frame of reference from the volume, so its positions do not apply</source>
        <translation>參考座標系與此體積不同，因此其位置不適用</translation>
    </message>
    <message>
        <source>is not a volume of labels: it must have at most 2000 different values, all whole numbers from 0 to 65535</source>
        <translation>不是標籤體積：不同的值最多 2000 種，且皆為 0 至 65535 的整數</translation>
    </message>
    <message>
        <source>the segment &apos;%1&apos; is outside the volume</source>
        <translation>分割區「%1」在體積之外</translation>
    </message>
    <message>
        <source>segments outside the volume: %1</source>
        <translation>體積之外的分割區：%1</translation>
    </message>
    <message>
        <source>not enough memory for the difference of two volumes</source>
        <translation>記憶體不足以計算兩個體積的差異</translation>
    </message>
    <message>
        <source>the two volumes do not overlap</source>
        <translation>兩個體積沒有重疊</translation>
    </message>
    <message>
        <source>needs %1 frames; a file has at most %2</source>
        <translation>需要 %1 格，一個檔案最多 %2 格</translation>
    </message>
    <message>
        <source>segments are left out: a look has at most %1 classes</source>
        <translation>有分割區未列入：外觀最多有 %1 個類別</translation>
    </message>
    <message>
        <source>the weight %1 is not between %2 and %3</source>
        <translation>權重 %1 不在 %2 與 %3 之間</translation>
    </message>
    <message>
        <source>is drawn and cannot be a segment, too</source>
        <translation>是手繪的，不能同時是分割區</translation>
    </message>
    <message>
        <source>classes within classes are nested too deep</source>
        <translation>類別中的類別層數過多</translation>
    </message>
    <message>
        <source>the step &apos;%1&apos; needs another class</source>
        <translation>步驟「%1」需要另一個類別</translation>
    </message>
    <message>
        <source>the steps of the class &apos;%1&apos; need the class &apos;%2&apos;, which the look does not have</source>
        <translation>類別「%1」的步驟需要類別「%2」，但外觀中沒有</translation>
    </message>
    <message>
        <source>the steps of the class &apos;%1&apos; combine it with itself</source>
        <translation>類別「%1」的步驟將它與自己組合</translation>
    </message>
    <message>
        <source>the steps of the class &apos;%1&apos; combine more than %2 classes</source>
        <translation>類別「%1」的步驟組合了超過 %2 個類別</translation>
    </message>
    <message>
        <source>a point is not finite</source>
        <translation>有一個點不是有限的數</translation>
    </message>
    <message>
        <source>the step &apos;%1&apos; has %2 strokes or cuts; at most %3 are allowed</source>
        <translation>步驟「%1」有 %2 個筆畫或剪裁；最多 %3 個</translation>
    </message>
    <message>
        <source>the radius of %1 mm is not between %2 and %3 mm</source>
        <translation>半徑 %1 mm 不在 %2 與 %3 mm 之間</translation>
    </message>
    <message>
        <source>the line of sight of a cut is not a unit vector</source>
        <translation>剪裁的視線不是單位向量</translation>
    </message>
    <message>
        <source>the slab of a cut is empty</source>
        <translation>剪裁的厚切是空的</translation>
    </message>
    <message>
        <source>the class &apos;%1&apos; needs a point in the patient; set it with --point &apos;%1=x,y,z&apos;</source>
        <translation>類別「%1」需要病患中的一點；請以 --point &apos;%1=x,y,z&apos; 指定</translation>
    </message>
    <message>
        <source>the scene shows a difference of two volumes; subtract the other volume first</source>
        <translation>此場景顯示兩個體積的差異；請先減去另一個體積</translation>
    </message>
    <message>
        <source>the steps of the class &apos;%1&apos; need the class &apos;%2&apos;, and the look has several of that name</source>
        <translation>類別「%1」的步驟需要類別「%2」，但外觀中有數個同名類別</translation>
    </message>
    <message>
        <source>the amplification of detail must be between 0 and 4, its size between 0.01 and 20 mm</source>
        <translation>細節的放大倍數必須在 0 與 4 之間，大小在 0.01 與 20 mm 之間</translation>
    </message>
    <message>
        <source>detail and latitude must be between 0 and 1</source>
        <translation>細節與寬容度必須在 0 與 1 之間</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not an angulation. Write, for example, &apos;LAO 30 CRA 20&apos;: LAO or RAO up to 180 degrees, CRA or CAU up to 90</source>
        <translation>「%1」不是角度。請寫如「LAO 30 CRA 20」：LAO 或 RAO 至 180 度，CRA 或 CAU 至 90 度</translation>
    </message>
    <message>
        <source>invalid exposure: the lower end of each range must be below the upper end</source>
        <translation>無效的曝光：每個範圍的下限必須低於上限</translation>
    </message>
    <message>
        <source>the values are not SUV: %1</source>
        <translation>數值不是 SUV：%1</translation>
    </message>
    <message>
        <source>the files give them in the unit &apos;%1&apos;</source>
        <translation>檔案以單位「%1」記錄</translation>
    </message>
    <message>
        <source>they are normalized by &apos;%1&apos;, not by body weight</source>
        <translation>數值以「%1」標準化，而非體重</translation>
    </message>
    <message>
        <source>the patient&apos;s weight is missing or implausible</source>
        <translation>病患體重缺少或不合理</translation>
    </message>
    <message>
        <source>the files are not corrected for decay</source>
        <translation>檔案未作衰變校正</translation>
    </message>
    <message>
        <source>the time from injection to scan or the half-life is missing or implausible</source>
        <translation>注射至掃描的時間或半衰期缺少或不合理</translation>
    </message>
    <message>
        <source>it must have %1 to %2 points</source>
        <translation>必須有 %1 至 %2 個點</translation>
    </message>
    <message>
        <source>regions are measured in planes, not in projections</source>
        <translation>區域在切面中測量，不在投影中測量</translation>
    </message>
    <message>
        <source>the range of a transfer function must be within 0 to 1 and at least %1 wide</source>
        <translation>轉換函數的範圍必須在 0 至 1 之內，且至少寬 %1</translation>
    </message>
    <message>
        <source>the injected activity is missing or implausible</source>
        <translation>注射活度缺少或不合理</translation>
    </message>
    <message>
        <source>the files are not corrected for attenuation</source>
        <translation>檔案未作衰減校正</translation>
    </message>
    <message>
        <source>the network helper sent implausible data</source>
        <translation>網路輔助程式傳來不合理的資料</translation>
    </message>
    <message>
        <source>the network helper cannot be started: %1</source>
        <translation>無法啟動網路輔助程式：%1</translation>
    </message>
    <message>
        <source>the network helper crashed</source>
        <translation>網路輔助程式當掉</translation>
    </message>
    <message>
        <source>the server made the network helper attempt a forbidden system call</source>
        <translation>伺服器使網路輔助程式嘗試被禁止的系統呼叫</translation>
    </message>
    <message>
        <source>the network helper does not answer</source>
        <translation>網路輔助程式沒有回應</translation>
    </message>
    <message>
        <source>the network cannot be set up</source>
        <translation>無法設定網路</translation>
    </message>
    <message>
        <source>there is no host named &apos;%1&apos;; check the name, and the connection to the network</source>
        <translation>沒有名為「%1」的主機；請檢查名稱與網路連線</translation>
    </message>
    <message>
        <source>the host does not answer; check address and port, and any firewall</source>
        <translation>主機沒有回應；請檢查位址、連接埠與防火牆</translation>
    </message>
    <message>
        <source>the host refuses connections to this port; check the port, and that the server runs</source>
        <translation>主機拒絕連線至此連接埠；請檢查連接埠，並確認伺服器正在執行</translation>
    </message>
    <message>
        <source>cannot connect: %1</source>
        <translation>無法連線：%1</translation>
    </message>
    <message>
        <source>is not a usable file in PEM format: %1</source>
        <translation>不是可用的 PEM 格式檔案：%1</translation>
    </message>
    <message>
        <source>is not the private key of the certificate</source>
        <translation>不是該憑證的私密金鑰</translation>
    </message>
    <message>
        <source>the other side&apos;s certificate is not accepted: %1</source>
        <translation>不接受對方的憑證：%1</translation>
    </message>
    <message>
        <source>TLS fails: %1</source>
        <translation>TLS 失敗：%1</translation>
    </message>
    <message>
        <source>the other side does not speak TLS on this port</source>
        <translation>對方在此連接埠不使用 TLS</translation>
    </message>
    <message>
        <source>the server accepts the connection, but does not answer</source>
        <translation>伺服器接受連線，但沒有回應</translation>
    </message>
    <message>
        <source>the server does not agree to a DICOM association: %1</source>
        <translation>伺服器不同意建立 DICOM 連結：%1</translation>
    </message>
    <message>
        <source>the server does not know this program; register its AE title at the server</source>
        <translation>伺服器不認得本程式；請在伺服器登錄其 AE 名稱</translation>
    </message>
    <message>
        <source>the server does not accept this AE title as its own; check the AE title of the server</source>
        <translation>伺服器的 AE 名稱不同</translation>
    </message>
    <message>
        <source>the server is busy</source>
        <translation>伺服器忙碌中</translation>
    </message>
    <message>
        <source>the server does not accept more connections</source>
        <translation>伺服器不接受更多連線</translation>
    </message>
    <message>
        <source>the server rejects the association</source>
        <translation>伺服器拒絕連結</translation>
    </message>
    <message>
        <source>the server has sent nothing for %1 s</source>
        <translation>伺服器已有 %1 秒沒有傳送任何資料</translation>
    </message>
    <message>
        <source>the other side closed the connection</source>
        <translation>對方關閉了連線</translation>
    </message>
    <message>
        <source>the connection fails: %1</source>
        <translation>連線失敗：%1</translation>
    </message>
    <message>
        <source>the sender asked for something other than storing</source>
        <translation>傳送端要求儲存以外的服務</translation>
    </message>
    <message>
        <source>the sender %1 is not known</source>
        <translation>不認得傳送端 %1</translation>
    </message>
    <message>
        <source>the sender %1 called the AE title %2, which is not this program&apos;s</source>
        <translation>傳送端 %1 要連至 %2</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1（%2）</translation>
    </message>
    <message>
        <source>%1 (%2: %3)</source>
        <translation>%1（%2：%3）</translation>
    </message>
    <message>
        <source>the server does not accept the object</source>
        <translation>伺服器不接受此物件</translation>
    </message>
    <message>
        <source>the server does not support this kind of object or service</source>
        <translation>伺服器不支援此種物件或服務</translation>
    </message>
    <message>
        <source>the server does not allow it</source>
        <translation>伺服器不允許</translation>
    </message>
    <message>
        <source>the server does not know the operation</source>
        <translation>伺服器不認得此操作</translation>
    </message>
    <message>
        <source>the server is out of resources</source>
        <translation>伺服器資源不足</translation>
    </message>
    <message>
        <source>the server does not have enough resources to count the objects</source>
        <translation>伺服器資源不足，無法計算物件數</translation>
    </message>
    <message>
        <source>the server does not have enough resources to send the objects</source>
        <translation>伺服器資源不足，無法傳送物件</translation>
    </message>
    <message>
        <source>the server does not know where to send; register the AE title, address and port of this program at the server</source>
        <translation>伺服器不知道傳送的目的地；請在伺服器登錄本程式的 AE 名稱、位址與連接埠</translation>
    </message>
    <message>
        <source>the server could not send all objects</source>
        <translation>伺服器無法傳送所有物件</translation>
    </message>
    <message>
        <source>the server reports that the data do not match the kind of object</source>
        <translation>伺服器回報資料與物件種類不符</translation>
    </message>
    <message>
        <source>the server cannot process the request</source>
        <translation>伺服器無法處理此要求</translation>
    </message>
    <message>
        <source>the server does not accept the encoding %1</source>
        <translation>伺服器不接受編碼 %1</translation>
    </message>
    <message>
        <source>the server&apos;s answer is not DICOM JSON; check the path of the service</source>
        <translation>伺服器的回應不是 DICOM JSON；請檢查服務的路徑</translation>
    </message>
    <message>
        <source>the server does not accept the user name, password or token</source>
        <translation>伺服器不接受使用者名稱、密碼或權杖</translation>
    </message>
    <message>
        <source>the server has nothing at this address; check the path of the service</source>
        <translation>伺服器在此位址沒有內容；請檢查服務的路徑</translation>
    </message>
    <message>
        <source>the server answers with HTTP status %1</source>
        <translation>伺服器回應 HTTP 狀態 %1</translation>
    </message>
    <message>
        <source>the server does not confirm that it stored the object</source>
        <translation>伺服器沒有確認已儲存物件</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not a port; use 1 to 65535</source>
        <translation>「%1」不是連接埠；請用 1 至 65535</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not an AE title; use 1 to 16 letters and digits</source>
        <translation>「%1」不是 AE 名稱；請用 1 至 16 個字母與數字</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not the address of a DICOM server; use AET@HOST:PORT</source>
        <translation>「%1」不是 DICOM 伺服器的位址；請用 AET@HOST:PORT</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not the address of a DICOMweb service; use https://HOST:PORT/PATH</source>
        <translation>「%1」不是 DICOMweb 服務的位址；請用 https://HOST:PORT/PATH</translation>
    </message>
    <message>
        <source>use 1 to %1 connections</source>
        <translation>請用 1 至 %1 條連線</translation>
    </message>
    <message>
        <source>a certificate needs its private key, and a key its certificate</source>
        <translation>憑證需要其私密金鑰，金鑰亦需要其憑證</translation>
    </message>
    <message>
        <source>there is no server &apos;%1&apos;</source>
        <translation>沒有伺服器「%1」</translation>
    </message>
    <message>
        <source>there is no folder for the user&apos;s data</source>
        <translation>沒有存放使用者資料的資料夾</translation>
    </message>
    <message>
        <source>is from a newer version of the program</source>
        <translation>來自較新版本的程式</translation>
    </message>
    <message>
        <source>the server has no such study or series</source>
        <translation>伺服器沒有此檢查或序列</translation>
    </message>
    <message>
        <source>the server could not send it</source>
        <translation>伺服器無法傳送</translation>
    </message>
    <message>
        <source>the server did not send it, and gave no reason</source>
        <translation>伺服器沒有傳送，也未說明原因</translation>
    </message>
    <message>
        <source>is not the object that the server announced</source>
        <translation>不是伺服器所宣告的物件</translation>
    </message>
    <message>
        <source>has no valid unique identifiers</source>
        <translation>沒有有效的唯一識別碼</translation>
    </message>
    <message>
        <source>&apos;%1&apos; cannot be searched for: it contains a backslash or a control character</source>
        <translation>無法搜尋「%1」：其中含有反斜線或控制字元</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not a date or a range of dates; use YYYYMMDD or YYYYMMDD-YYYYMMDD</source>
        <translation>「%1」不是日期或日期範圍；請用 YYYYMMDD 或 YYYYMMDD-YYYYMMDD</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not a unique identifier</source>
        <translation>「%1」不是唯一識別碼</translation>
    </message>
    <message>
        <source>series and images are searched for within a study: name its UID</source>
        <translation>序列與影像須在檢查中搜尋：請指定其 UID</translation>
    </message>
    <message>
        <source>images are searched for within a series: name its UID</source>
        <translation>影像須在序列中搜尋：請指定其 UID</translation>
    </message>
    <message>
        <source>port %1 cannot be used: %2</source>
        <translation>無法使用連接埠 %1：%2</translation>
    </message>
    <message>
        <source>the list of transfers cannot be used: %1</source>
        <translation>無法使用傳輸清單：%1</translation>
    </message>
    <message>
        <source>there is no transfer %1</source>
        <translation>沒有傳輸 %1</translation>
    </message>
    <message>
        <source>not all servers answered</source>
        <translation>並非所有伺服器皆有回應</translation>
    </message>
    <message>
        <source>a password is needed, and there is no terminal to ask for it</source>
        <translation>需要密碼，但沒有可詢問的終端機</translation>
    </message>
    <message>
        <source>another program is working on this transfer</source>
        <translation>另一個程式正在處理此傳輸</translation>
    </message>
    <message>
        <source>was cancelled</source>
        <translation>已取消</translation>
    </message>
    <message>
        <source>the files describe several injections</source>
        <translation>檔案記載多次注射</translation>
    </message>
    <message>
        <source>the half-life is not that of the radionuclide</source>
        <translation>半衰期與放射性核種不符</translation>
    </message>
    <message>
        <source>the files state different units, weights, injections or corrections</source>
        <translation>各檔案的單位、體重、注射或校正不同</translation>
    </message>
    <message>
        <source>the size of detail is larger than the radius of the volume</source>
        <translation>細節的大小超過體積的半徑</translation>
    </message>
    <message>
        <source>the server sends more than was asked for</source>
        <translation>伺服器傳送的內容多於所要求者</translation>
    </message>
    <message>
        <source>the server failed to process the request</source>
        <translation>伺服器無法處理此要求</translation>
    </message>
    <message>
        <source>no DICOM server that could send is in the list; add one</source>
        <translation>清單中沒有可傳送的 DICOM 伺服器；請新增一個</translation>
    </message>
    <message>
        <source>the private key for receiving is protected by a password; use one without</source>
        <translation>接收用的私密金鑰有密碼保護；請使用沒有密碼的金鑰</translation>
    </message>
    <message>
        <source>is not a link that can be opened; use pellucid://open?server=NAME&amp;studyUID=UID</source>
        <translation>不是可開啟的連結；請使用 pellucid://open?server=NAME&amp;studyUID=UID</translation>
    </message>
    <message>
        <source>the turntable would need more than %1 MB; choose fewer frames or a smaller size</source>
        <translation>環繞一周將需要超過 %1 MB；請選擇較少格數或較小尺寸</translation>
    </message>
    <message>
        <source>only DICOM pictures can be sent; choose a DICOM format</source>
        <translation>只能傳送 DICOM 圖片；請選擇 DICOM 格式</translation>
    </message>
    <message>
        <source>the server&apos;s answer is too long</source>
        <translation>伺服器的回應過長</translation>
    </message>
    <message>
        <source>a login in the browser is for DICOMweb servers only</source>
        <translation>在瀏覽器中登入僅適用於 DICOMweb 伺服器</translation>
    </message>
    <message>
        <source>a server with a login in the browser needs an https address, so that nobody reads the token in transit</source>
        <translation>在瀏覽器中登入的伺服器須使用 https 網址，以免權杖在途中被讀取</translation>
    </message>
    <message>
        <source>a login in the browser needs the issuer URL, or the authorization URL and the token URL</source>
        <translation>在瀏覽器中登入需要發行者的網址，或授權與權杖的網址</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not the address of a login server; use https://HOST/PATH</source>
        <translation>「%1」不是登入伺服器的網址；請使用 https://HOST/PATH</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not a client ID; enter the ID that the login server has for this program</source>
        <translation>「%1」不是用戶端識別碼；請輸入登入伺服器給予本程式的識別碼</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not a scope; use words of ASCII characters, separated by spaces</source>
        <translation>「%1」不是範圍；請使用以空格分隔的 ASCII 字詞</translation>
    </message>
    <message>
        <source>the login server does not publish its endpoints; enter the authorization URL and the token URL</source>
        <translation>登入伺服器未說明其網址；請輸入授權與權杖的網址</translation>
    </message>
    <message>
        <source>nobody logged in within %1 s</source>
        <translation>%1 秒內無人登入</translation>
    </message>
    <message>
        <source>the login was denied</source>
        <translation>登入被拒絕</translation>
    </message>
    <message>
        <source>the login server refuses the login: %1</source>
        <translation>登入伺服器拒絕登入：%1</translation>
    </message>
    <message>
        <source>the login server&apos;s answer has no usable token</source>
        <translation>登入伺服器的回應中沒有可用的權杖</translation>
    </message>
    <message>
        <source>the login has expired; log in again</source>
        <translation>登入已過期；請重新登入</translation>
    </message>
    <message>
        <source>the other side sent data in a different presentation context from its command</source>
        <translation>對方所送資料的呈現環境與其命令不同</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not a calendar date</source>
        <translation>「%1」不是日曆上的日期</translation>
    </message>
    <message>
        <source>the range of dates &apos;%1&apos; ends before it begins</source>
        <translation>日期範圍「%1」的結束早於開始</translation>
    </message>
    <message>
        <source>&apos;%1&apos; cannot be searched for: it is not encoded in UTF-8</source>
        <translation>無法搜尋「%1」：其編碼不是 UTF-8</translation>
    </message>
    <message>
        <source>%1 does not apply to a search at the level &apos;%2&apos;</source>
        <translation>%1 不適用於層級「%2」的搜尋</translation>
    </message>
    <message>
        <source>the server only sends to other computers (C-MOVE), and this program receives on port %1 with other TLS settings: switch TLS on for both or for neither, or let the receiver use another port</source>
        <translation>伺服器只會傳送至其他電腦（C-MOVE），而本程式以不同的 TLS 設定在連接埠 %1 接收：請兩者皆開啟或皆關閉 TLS，或讓接收使用其他連接埠</translation>
    </message>
    <message>
        <source>port %1 is in use, perhaps by another receiver of Pellucid; close that one, or choose another port and register it at the server (on the command line: --port)</source>
        <translation>連接埠 %1 使用中，可能由 Pellucid 的另一個接收器使用；請關閉該接收器，或選擇其他連接埠並在伺服器登錄（命令列：--port）</translation>
    </message>
    <message>
        <source>%1 not received: %2</source>
        <translation>未收到 %1 個：%2</translation>
    </message>
    <message>
        <source>%1 not sent: %2</source>
        <translation>未傳送 %1 個：%2</translation>
    </message>
    <message>
        <source>declares more frames than the file can hold: %1</source>
        <translation>宣告的影格數多於檔案所能容納：%1</translation>
    </message>
    <message>
        <source>has a wrong number of compressed frames: %1 instead of %2</source>
        <translation>壓縮影格數錯誤：%1，應為 %2</translation>
    </message>
    <message>
        <source>a run-length frame has a wrong number of segments: %1 instead of %2</source>
        <translation>游程編碼影格的區段數錯誤：%1，應為 %2</translation>
    </message>
    <message>
        <source>a run-length segment decodes to a wrong number of bytes: %1 instead of %2</source>
        <translation>游程編碼區段解碼後的位元組數錯誤：%1，應為 %2</translation>
    </message>
    <message>
        <source>a run-length segment has more bytes than its image needs: %1</source>
        <translation>游程編碼區段的位元組多於影像所需：%1</translation>
    </message>
    <message>
        <source>the number of points is %1, not between %2 and %3</source>
        <translation>點數為 %1，不在 %2 與 %3 之間</translation>
    </message>
    <message>
        <source>is not the matrix of a parallel projection: the third row must be 0, 0, 0 and a number other than 0</source>
        <translation>不是平行投影的矩陣：第三列須為 0、0、0 與一個非 0 的數</translation>
    </message>
    <message>
        <source>does not project on square pixels: the first three numbers of the first two rows must be perpendicular and of the same length</source>
        <translation>不是投影至方形像素：前兩列的前三個數須互相垂直且長度相同</translation>
    </message>
    <message>
        <source>has a different pixel size from earlier matrices</source>
        <translation>像素大小與先前的矩陣不同</translation>
    </message>
    <message>
        <source>must be three rows of four numbers</source>
        <translation>須為三列、每列四個數</translation>
    </message>
    <message>
        <source>must be a whole number from %1 to %2</source>
        <translation>須為 %1 至 %2 的整數</translation>
    </message>
    <message>
        <source>must not be empty</source>
        <translation>不可為空</translation>
    </message>
    <message>
        <source>must be a name of 1 to %1 letters, digits, &apos;-&apos;, &apos;_&apos;, &apos;.&apos; and &apos;,&apos;</source>
        <translation>須為 1 至 %1 個字母、數字、「-」、「_」、「.」與「,」組成的名稱</translation>
    </message>
    <message>
        <source>needs a turntable or several views</source>
        <translation>需要環繞一周或多個視角</translation>
    </message>
    <message>
        <source>has more than one of view, views and turntable; only view and turntable go together</source>
        <translation>view、views 與 turntable 給定多於一個；只有 view 與 turntable 可以並用</translation>
    </message>
    <message>
        <source>another output has the name &apos;%1&apos;</source>
        <translation>名稱「%1」已屬於另一個輸出</translation>
    </message>
    <message>
        <source>is a matrix, which belongs to &apos;views&apos;</source>
        <translation>是矩陣，應置於「views」</translation>
    </message>
    <message>
        <source>recipes make projections; choose the projection</source>
        <translation>配方產生投影；請選擇投影</translation>
    </message>
    <message>
        <source>recipes cannot subtract volumes yet</source>
        <translation>配方尚不能相減體積</translation>
    </message>
    <message>
        <source>no series of the study matches the recipe</source>
        <translation>檢查中沒有配方所要求的序列</translation>
    </message>
    <message>
        <source>the study library was damaged; series recovered: %1, lost: %2; the old file is kept under this name</source>
        <translation>檢查庫已損毀；復原的序列：%1，遺失：%2；舊檔以此名稱保留</translation>
    </message>
    <message>
        <source>must be a list of length %1</source>
        <translation>須為長度 %1 的清單</translation>
    </message>
    <message>
        <source>the name &apos;%1&apos; is reserved for the record of the results</source>
        <translation>名稱「%1」保留給結果的紀錄</translation>
    </message>
    <message>
        <source>is for the formats dicom and dicom-loop: other formats contain no identity</source>
        <translation>僅用於 dicom 與 dicom-loop 格式：其他格式不含身分</translation>
    </message>
    <message>
        <source>no study matches</source>
        <translation>沒有符合的檢查</translation>
    </message>
    <message>
        <source>the member &apos;%1&apos; is given twice</source>
        <translation>成員「%1」出現兩次</translation>
    </message>
    <message>
        <source>lists and objects are nested too deeply</source>
        <translation>清單與物件的巢狀層數過深</translation>
    </message>
    <message>
        <source>not JSON: %1</source>
        <translation>不是 JSON：%1</translation>
    </message>
    <message>
        <source>needs a name: its default, &apos;%1&apos;, is the name of another output</source>
        <translation>需要名稱：預設名稱「%1」已是另一個輸出的名稱</translation>
    </message>
    <message>
        <source>cannot be met: the matrices determine what a picture contains</source>
        <translation>無法達成：影像的內容由矩陣決定</translation>
    </message>
    <message>
        <source>unknown member &apos;%1&apos;: use one of %2</source>
        <translation>未知的成員「%1」：請使用 %2 之一</translation>
    </message>
    <message>
        <source>is not a folder of results, and would be replaced</source>
        <translation>不是結果資料夾，將被取代</translation>
    </message>
    <message>
        <source>is a link that another user made, in a folder where anybody may make files</source>
        <translation>是其他使用者在任何人皆可建立檔案的資料夾中所建的連結</translation>
    </message>
    <message>
        <source>the sender&apos;s certificate names %1, but the sender is %2</source>
        <translation>傳送端的憑證載明 %1，但傳送端為 %2</translation>
    </message>
    <message>
        <source>the sender made no DICOM association within %1 s</source>
        <translation>傳送端未在 %1 秒內建立 DICOM 連結</translation>
    </message>
    <message>
        <source>the sender completed no message within %1 s</source>
        <translation>傳送端未在 %1 秒內完成任何訊息</translation>
    </message>
    <message>
        <source>the sender has too many connections at the same time</source>
        <translation>傳送端同時開啟的連線過多</translation>
    </message>
    <message>
        <source>more refused connections from %1: %2</source>
        <translation>另有來自 %1 的連線遭拒：%2 次</translation>
    </message>
    <message>
        <source>more refused connections from several addresses: %1</source>
        <translation>另有來自多個位址的連線遭拒：%1 次</translation>
    </message>
    <message>
        <source>without TLS, others on the network can read the password or token: use https or TLS, or allow it for this server (in the window: save it again; on the command line: server add with --allow-insecure-login)</source>
        <translation>未使用 TLS 時，網路上的其他人可讀取密碼或權杖：請使用 https 或 TLS，或對此伺服器允許（在視窗中：重新儲存；命令列：server add 加上 --allow-insecure-login）</translation>
    </message>
    <message>
        <source>the server only sends to other computers (C-MOVE): to receive with TLS, this program needs a certificate, its private key, and the CA certificates</source>
        <translation>伺服器僅能傳送至其他電腦（C-MOVE）：若要以 TLS 接收，本程式需要憑證、其私密金鑰與憑證機構的憑證</translation>
    </message>
    <message>
        <source>to receive with TLS, this program needs the certificates of the CAs that issued the senders&apos; certificates (on the command line: --authorities)</source>
        <translation>若要以 TLS 接收，本程式需要簽發傳送端憑證之憑證機構的憑證（命令列：--authorities）</translation>
    </message>
    <message>
        <source>only the last %1 MB of the disk are free, which are kept in reserve</source>
        <translation>磁碟僅剩最後 %1 MB 可用空間，此空間予以保留</translation>
    </message>
    <message>
        <source>the server lists more than %1 entries</source>
        <translation>伺服器列出超過 %1 個項目</translation>
    </message>
    <message>
        <source>%1 objects name a patient other than the one that the server lists</source>
        <translation>%1 個物件所載的病人與伺服器清單上的不同</translation>
    </message>
    <message>
        <source>the server lists more than %1 objects of the study</source>
        <translation>伺服器為此檢查列出超過 %1 個物件</translation>
    </message>
    <message>
        <source>this system cannot confine the processes that read files and talk to servers (no seccomp): a hostile file could do whatever you can do</source>
        <translation>此系統無法限制讀取檔案及與伺服器連線的處理程序：惡意檔案可執行您所能執行的一切</translation>
    </message>
    <message>
        <source>the server did not list it</source>
        <translation>伺服器未列出</translation>
    </message>
    <message>
        <source>the server has reached its limit: the list may be incomplete; narrow the search</source>
        <translation>伺服器已達其上限：清單可能不完整；請縮小搜尋範圍</translation>
    </message>
    <message>
        <source>entries without a valid UID, which cannot be opened: %1</source>
        <translation>沒有有效 UID 而無法開啟的項目：%1</translation>
    </message>
    <message>
        <source>the server behind the proxy does not answer (HTTP status %1)</source>
        <translation>代理伺服器後方的伺服器沒有回應（HTTP 狀態 %1）</translation>
    </message>
    <message>
        <source>the server requires a client certificate</source>
        <translation>伺服器要求本程式的憑證</translation>
    </message>
    <message>
        <source>has %1-bit samples, which are not supported</source>
        <translation>樣本為 %1 位元，不受支援</translation>
    </message>
    <message>
        <source>contours lie between the slices, up to %1 mm from the nearest: %2</source>
        <translation>輪廓位於切片之間，距最近的切片達 %1 mm：%2</translation>
    </message>
    <message>
        <source>several images have the same position, and nothing but their numbers tells them apart</source>
        <translation>多張影像位置相同，除編號外無從區分</translation>
    </message>
    <message>
        <source>slices %1 to %2 of %3: the field of view shifts by %4 mm between %5 and %6</source>
        <translation>切片 %1 至 %2（共 %3 張）：視野在 %5 與 %6 之間移動 %4 mm</translation>
    </message>
    <message>
        <source>guessed: images at the same position were told apart by their numbers alone</source>
        <translation>猜測：相同位置的影像僅以編號區分</translation>
    </message>
    <message>
        <source>files with one position for all frames, which were placed in their order by the spacing between slices: %1</source>
        <translation>所有影格只有一個位置、依切片間距按順序排列的檔案：%1</translation>
    </message>
    <message>
        <source>files with one position for all frames and no spacing, which were placed in their order by the slice thickness: %1</source>
        <translation>所有影格只有一個位置且無間距、依切片厚度按順序排列的檔案：%1</translation>
    </message>
    <message>
        <source>files whose numbers have a wrong value representation: %1</source>
        <translation>數字的值表示法錯誤的檔案：%1</translation>
    </message>
    <message>
        <source>mosaics without a number of slices, which were split by their acquisition matrix: %1</source>
        <translation>未載切片數、依擷取矩陣分割的馬賽克影像：%1</translation>
    </message>
    <message>
        <source>no Rescale Slope and Intercept: the values are taken as HU</source>
        <translation>沒有 Rescale Slope 與 Intercept：數值視為 HU</translation>
    </message>
    <message>
        <source>the images state different values: %1</source>
        <translation>各影像所載的值不同：%1</translation>
    </message>
    <message>
        <source>others</source>
        <translation>其他</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>heart interval %1</source>
        <translation>心搏間期 %1</translation>
    </message>
    <message>
        <source>time slot %1</source>
        <translation>時間槽 %1</translation>
    </message>
    <message>
        <source>phase %1</source>
        <translation>相位 %1</translation>
    </message>
    <message>
        <source>time %1</source>
        <translation>時間 %1</translation>
    </message>
    <message>
        <source>energy window %1</source>
        <translation>能窗 %1</translation>
    </message>
    <message>
        <source>detector %1</source>
        <translation>偵測器 %1</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>echo time %1 ms</source>
        <translation>回波時間 %1 ms</translation>
    </message>
    <message>
        <source>inversion time %1 ms</source>
        <translation>反轉時間 %1 ms</translation>
    </message>
    <message>
        <source>direction %1</source>
        <translation>方向 %1</translation>
    </message>
    <message>
        <source>flip angle %1°</source>
        <translation>翻轉角 %1°</translation>
    </message>
    <message>
        <source>%1 kVp</source>
        <translation>%1 kVp</translation>
    </message>
    <message>
        <source>kernel %1</source>
        <translation>重建核 %1</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>%1 ms</translation>
    </message>
    <message>
        <source>the server sends something other than DICOM objects</source>
        <translation>伺服器傳送的不是 DICOM 物件</translation>
    </message>
    <message>
        <source>the server wants https: change its address to %1</source>
        <translation>伺服器要求 https：請將位址改為 %1</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is neither the name nor the address of a host</source>
        <translation>「%1」既非主機名稱，也非位址</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not an address of this computer to receive on</source>
        <translation>「%1」不是本電腦可用於接收的位址</translation>
    </message>
    <message>
        <source>stored, but the server changed or left out attributes (%1)</source>
        <translation>已儲存，但伺服器變更或略去了屬性（%1）</translation>
    </message>
    <message>
        <source>the login server %1: %2</source>
        <translation>登入伺服器 %1：%2</translation>
    </message>
    <message>
        <source>the server offers neither C-GET nor C-MOVE</source>
        <translation>伺服器既不提供 C-GET，也不提供 C-MOVE</translation>
    </message>
    <message>
        <source>kinds of objects or encodings that this program does not take: %1</source>
        <translation>本程式不接受的物件種類或編碼：%1</translation>
    </message>
    <message>
        <source>the segments are coarser than the volume, or lie across its slices; they were interpolated</source>
        <translation>分割比體積粗，或橫跨其切片；已內插</translation>
    </message>
    <message>
        <source>at %1 mm right</source>
        <translation>右側 %1 mm 處</translation>
    </message>
    <message>
        <source>at %1 mm left</source>
        <translation>左側 %1 mm 處</translation>
    </message>
    <message>
        <source>at %1 mm anterior</source>
        <translation>前方 %1 mm 處</translation>
    </message>
    <message>
        <source>at %1 mm posterior</source>
        <translation>後方 %1 mm 處</translation>
    </message>
    <message>
        <source>at %1 mm towards the feet</source>
        <translation>足側 %1 mm 處</translation>
    </message>
    <message>
        <source>at %1 mm towards the head</source>
        <translation>頭側 %1 mm 處</translation>
    </message>
    <message>
        <source>the server ends the connection without accepting an association; perhaps it expects TLS</source>
        <translation>伺服器未接受關聯即結束連線；可能需要 TLS</translation>
    </message>
    <message>
        <source>the server does not accept objects of this size</source>
        <translation>伺服器不接受此大小的物件</translation>
    </message>
    <message>
        <source>the server&apos;s answer is incomplete</source>
        <translation>伺服器的回應不完整</translation>
    </message>
    <message>
        <source>the server redirects too often</source>
        <translation>伺服器重新導向次數過多</translation>
    </message>
    <message>
        <source>%1; the server reports: %2</source>
        <translation>%1；伺服器訊息：%2</translation>
    </message>
    <message>
        <source>a sender at %1 was refused: it is not an address of the server; if the server sends from there, add it (in the window: Sends from; on the command line: server add with --sends-from)</source>
        <translation>已拒絕 %1 的傳送者：並非伺服器的位址；若伺服器由該處傳送，請加入（視窗中：傳送來源；命令列：server add 加上 --sends-from）</translation>
    </message>
    <message>
        <source>%1 not sent, for %2 reasons</source>
        <translation>%1 個未送出，原因有 %2 種</translation>
    </message>
    <message>
        <source>the study is not complete: %1 of its objects are missing</source>
        <translation>檢查不完整：缺少 %1 個物件</translation>
    </message>
    <message>
        <source>files with decimal commas, which were accepted: %1</source>
        <translation>數值中有逗號而已讀取的檔案：%1</translation>
    </message>
    <message>
        <source>without Rescale Slope or Intercept, unlike other images of the series: the values are taken as they are</source>
        <translation>與序列中其他影像不同，沒有 Rescale Slope 或 Intercept：數值照原樣採用</translation>
    </message>
    <message>
        <source>not enough memory to measure the error of a picture</source>
        <translation>記憶體不足，無法測量圖片的誤差</translation>
    </message>
    <message>
        <source>is a study library from another version of the program</source>
        <translation>是其他版本程式的檢查資料庫</translation>
    </message>
    <message>
        <source>no web browser is set up to open the manual</source>
        <translation>未設定可開啟手冊的瀏覽器</translation>
    </message>
    <message>
        <source>needs a size: give --size with --matrix</source>
        <translation>需要大小：請以 --matrix 搭配 --size</translation>
    </message>
    <message>
        <source>unexpected response from the server</source>
        <translation>伺服器的回應不符預期</translation>
    </message>
    <message>
        <source>the server redirects to another server; redirects are not followed</source>
        <translation>伺服器轉向另一部伺服器；不跟隨轉向</translation>
    </message>
    <message>
        <source>%1; it may accept the file uncompressed: tick &apos;Decompress if the encoding is not accepted&apos; for this server (on the command line: server add with --uncompress)</source>
        <translation>%1；它可能接受未壓縮的檔案：請為此伺服器勾選「不接受該編碼時解壓縮」（命令列：server add 加上 --uncompress）</translation>
    </message>
    <message>
        <source>cannot be met with both pixel_mm and size; remove one</source>
        <translation>pixel_mm 與 size 和「fit」矛盾；請移除其一</translation>
    </message>
    <message>
        <source>contains &apos;%1&apos;, which is not a result; choose an empty folder</source>
        <translation>含有「%1」，這不是結果；請選擇空的資料夾</translation>
    </message>
    <message>
        <source>no study is open</source>
        <translation>沒有開啟的檢查</translation>
    </message>
    <message>
        <source>the projection is not computed (F5 to recompute)</source>
        <translation>尚未計算投影（按 F5 重新計算）</translation>
    </message>
    <message>
        <source>the other side&apos;s certificate is not accepted: %1; if you trust it, add its CA certificates (in the window: CA certificates; on the command line: server add with --authorities)</source>
        <translation>不接受對方的憑證：%1；若您信任此伺服器，請加入其憑證機構的憑證（視窗中：CA 憑證；命令列：server add 加上 --authorities）</translation>
    </message>
    <message>
        <source>the manual is not installed</source>
        <translation>未安裝使用手冊</translation>
    </message>
    <message>
        <source>the server has corrected %1 objects since they were received; use &apos;get --replace&apos; to retrieve them again</source>
        <translation>伺服器在接收後更正了 %1 個物件；請用「get --replace」重新取回</translation>
    </message>
    <message>
        <source>%1; %2 runs only with --allow-unprotected</source>
        <translation>%1；%2 僅在給定 --allow-unprotected 時執行</translation>
    </message>
    <message>
        <source>all its studies are in the folder of results (--out), which is not searched</source>
        <translation>其中的檢查都在結果資料夾（--out）中，該資料夾不會被搜尋</translation>
    </message>
    <message>
        <source>%1 of %2 slices have arrived</source>
        <translation>已收到 %2 張切片中的 %1 張</translation>
    </message>
    <message>
        <source>the segments do not lie on the volume&apos;s samples (up to %1 mm away); they were interpolated</source>
        <translation>分割不在體積的樣本上（相距達 %1 mm）；已內插</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not a valid server name; use 1 to 64 bytes, without control characters</source>
        <translation>「%1」不是有效的伺服器名稱；請用 1 至 64 個位元組，不含控制字元</translation>
    </message>
    <message>
        <source>the maximum number of results must be at most %1</source>
        <translation>結果數的上限最多為 %1</translation>
    </message>
    <message>
        <source>the login server reports the issuer &apos;%1&apos;; if that is correct, enter it as the issuer</source>
        <translation>登入伺服器回報的發行者為「%1」；若正確，請將其輸入為發行者</translation>
    </message>
    <message>
        <source>a different object with the same UID has already been received</source>
        <translation>已收到 UID 相同的另一個物件</translation>
    </message>
    <message>
        <source>the patient&apos;s name is &apos;%1&apos; on this computer, but &apos;%2&apos; on the server</source>
        <translation>病人姓名在本機為「%1」，但在伺服器上為「%2」</translation>
    </message>
    <message>
        <source>the patient&apos;s ID is &apos;%1&apos; on this computer, but &apos;%2&apos; on the server</source>
        <translation>病歷號在本機為「%1」，但在伺服器上為「%2」</translation>
    </message>
    <message>
        <source>the birth date is &apos;%1&apos; on this computer, but &apos;%2&apos; on the server</source>
        <translation>出生日期在本機為「%1」，但在伺服器上為「%2」</translation>
    </message>
    <message>
        <source>the study date is &apos;%1&apos; on this computer, but &apos;%2&apos; on the server</source>
        <translation>檢查日期在本機為「%1」，但在伺服器上為「%2」</translation>
    </message>
    <message>
        <source>is not the study of the last session</source>
        <translation>不是上次工作階段的檢查</translation>
    </message>
    <message>
        <source>the whole volume at a pixel size of %2 mm needs an image of more than %1 pixels a side; set a size or a larger pixel size</source>
        <translation>以 %2 mm 的像素大小顯示整個體積，影像每邊需要超過 %1 個像素；請設定影像大小或較大的像素大小</translation>
    </message>
    <message>
        <source>the fastest that meets the tolerance</source>
        <translation>符合容差且最快</translation>
    </message>
    <message>
        <source>the fastest that meets the tolerance with the chosen %1</source>
        <translation>以所選的%1符合容差且最快</translation>
    </message>
    <message>
        <source>files that are not images: %1</source>
        <translation>不是影像的檔案：%1</translation>
    </message>
    <message>
        <source>for one picture, summing along the view is faster than computing a spectrum</source>
        <translation>只有一張影像時，沿視線方向加總比計算頻譜快</translation>
    </message>
    <message>
        <source>sums along the view, %1</source>
        <translation>沿視線方向加總，%1</translation>
    </message>
    <message>
        <source>Another program has it open</source>
        <translation>另一個程式正在使用它</translation>
    </message>
    <message>
        <source>this system has no list of trusted CA certificates; name a file of CA certificates (on the command line: --authorities)</source>
        <translation>此系統沒有受信任的 CA 憑證清單；請指定含有 CA 憑證的檔案（命令列：--authorities）</translation>
    </message>
</context>
<context>
    <name>RegionTexts</name>
    <message>
        <source>New region</source>
        <translation>新區域</translation>
    </message>
    <message>
        <source>Add region</source>
        <translation>加入區域</translation>
    </message>
    <message>
        <source>Keep region</source>
        <translation>保留區域</translation>
    </message>
    <message>
        <source>Remove region</source>
        <translation>移除區域</translation>
    </message>
    <message>
        <source>Scissors</source>
        <translation>剪刀</translation>
    </message>
    <message>
        <source>Erase</source>
        <translation>擦除</translation>
    </message>
    <message>
        <source>Paint</source>
        <translation>塗畫</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>點</translation>
    </message>
    <message>
        <source>Remove the couch</source>
        <translation>移除檢查床</translation>
    </message>
    <message>
        <source>Show the couch</source>
        <translation>顯示檢查床</translation>
    </message>
</context>
<context>
    <name>StepTexts</name>
    <message>
        <source>Standard deviation</source>
        <translation>標準差</translation>
    </message>
    <message>
        <source>Half the side of the neighborhood</source>
        <translation>鄰域邊長的一半</translation>
    </message>
    <message>
        <source>Number of iterations</source>
        <translation>迭代次數</translation>
    </message>
    <message>
        <source>Lower values preserve more edges</source>
        <translation>數值越低，保留的邊緣越多</translation>
    </message>
    <message>
        <source>Standard deviation of prior smoothing</source>
        <translation>先行平滑的標準差</translation>
    </message>
    <message>
        <source>Minimum</source>
        <translation>最小值</translation>
    </message>
    <message>
        <source>Maximum</source>
        <translation>最大值</translation>
    </message>
    <message>
        <source>An edge continues above this</source>
        <translation>邊緣在此值以上延續</translation>
    </message>
    <message>
        <source>An edge starts above this</source>
        <translation>邊緣在此值以上開始</translation>
    </message>
    <message>
        <source>1: use ITK&apos;s filters, slower</source>
        <translation>1：使用 ITK 濾波器，較慢</translation>
    </message>
    <message>
        <source>Radius of the ball</source>
        <translation>球的半徑</translation>
    </message>
    <message>
        <source>Minimum size of a part relative to the largest</source>
        <translation>相對於最大部分的最小大小</translation>
    </message>
    <message>
        <source>Not through openings narrower than this</source>
        <translation>不穿過比此更窄的開口</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>距離</translation>
    </message>
    <message>
        <source>Depth</source>
        <translation>深度</translation>
    </message>
    <message>
        <source>Margin around the skin</source>
        <translation>皮膚外的邊緣</translation>
    </message>
    <message>
        <source>Depth below the skin</source>
        <translation>皮膚下的深度</translation>
    </message>
    <message>
        <source>Margin outside the skin</source>
        <translation>皮膚外的邊緣</translation>
    </message>
    <message>
        <source>Smooth with a Gaussian</source>
        <translation>高斯平滑</translation>
    </message>
    <message>
        <source>Median</source>
        <translation>中值</translation>
    </message>
    <message>
        <source>Smooth along edges</source>
        <translation>沿邊緣平滑</translation>
    </message>
    <message>
        <source>Gradient</source>
        <translation>梯度</translation>
    </message>
    <message>
        <source>Change the sign</source>
        <translation>改變正負號</translation>
    </message>
    <message>
        <source>Hard range of values</source>
        <translation>硬性數值範圍</translation>
    </message>
    <message>
        <source>Edges</source>
        <translation>邊緣</translation>
    </message>
    <message>
        <source>Uniform density above a value</source>
        <translation>高於某值則密度為一</translation>
    </message>
    <message>
        <source>Remove what is thin</source>
        <translation>去除細薄部分</translation>
    </message>
    <message>
        <source>Close narrow gaps</source>
        <translation>閉合窄縫</translation>
    </message>
    <message>
        <source>Largest part</source>
        <translation>最大部分</translation>
    </message>
    <message>
        <source>Grow</source>
        <translation>擴張</translation>
    </message>
    <message>
        <source>Shrink</source>
        <translation>收縮</translation>
    </message>
    <message>
        <source>Fill holes</source>
        <translation>填滿孔洞</translation>
    </message>
    <message>
        <source>The patient without the couch</source>
        <translation>不含檢查床的病患</translation>
    </message>
    <message>
        <source>The skin</source>
        <translation>皮膚</translation>
    </message>
    <message>
        <source>And another class</source>
        <translation>且另一類別</translation>
    </message>
    <message>
        <source>Or another class</source>
        <translation>或另一類別</translation>
    </message>
    <message>
        <source>Without another class</source>
        <translation>去除另一類別</translation>
    </message>
    <message>
        <source>Painted</source>
        <translation>塗畫</translation>
    </message>
    <message>
        <source>Scissors</source>
        <translation>剪刀</translation>
    </message>
    <message>
        <source>smoothed by %1 mm</source>
        <translation>平滑 %1 mm</translation>
    </message>
    <message>
        <source>median within %1 mm</source>
        <translation>%1 mm 內的中值</translation>
    </message>
    <message>
        <source>without parts thinner than %1 mm</source>
        <translation>去除薄於 %1 mm 的部分</translation>
    </message>
    <message>
        <source>gaps up to %1 mm closed</source>
        <translation>閉合 %1 mm 以內的縫隙</translation>
    </message>
    <message>
        <source>grown by %1 mm</source>
        <translation>擴張 %1 mm</translation>
    </message>
    <message>
        <source>shrunk by %1 mm</source>
        <translation>收縮 %1 mm</translation>
    </message>
    <message>
        <source>holes filled</source>
        <translation>孔洞已填滿</translation>
    </message>
    <message>
        <source>within the patient</source>
        <translation>在病患之內</translation>
    </message>
    <message>
        <source>the skin only</source>
        <translation>僅皮膚</translation>
    </message>
    <message>
        <source>and %1</source>
        <translation>且 %1</translation>
    </message>
    <message>
        <source>or %1</source>
        <translation>或 %1</translation>
    </message>
    <message>
        <source>without %1</source>
        <translation>去除 %1</translation>
    </message>
    <message numerus="yes">
        <source>%n stroke(s)</source>
        <translation>
            <numerusform>%n 筆</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n cut(s)</source>
        <translation>
            <numerusform>%n 刀</numerusform>
        </translation>
    </message>
    <message>
        <source>parts of at least %1 of the largest</source>
        <translation>至少為最大部分 %1 倍的部分</translation>
    </message>
    <message>
        <source>largest part</source>
        <translation>最大部分</translation>
    </message>
    <message>
        <source>drawn</source>
        <translation>手繪</translation>
    </message>
    <message>
        <source>from %1</source>
        <translation>自 %1</translation>
    </message>
    <message>
        <source>up to %1</source>
        <translation>至 %1</translation>
    </message>
    <message>
        <source>all values</source>
        <translation>所有數值</translation>
    </message>
    <message>
        <source>mm</source>
        <translation>mm</translation>
    </message>
    <message>
        <source>value units</source>
        <translation>數值單位</translation>
    </message>
    <message>
        <source>value units per mm</source>
        <translation>數值單位／mm</translation>
    </message>
    <message>
        <source>connected to a point to be clicked</source>
        <translation>與待點按的點相連</translation>
    </message>
    <message numerus="yes">
        <source>connected to %n point(s), not through openings narrower than %1 mm</source>
        <translation>
            <numerusform>與 %n 個點相連，不穿過窄於 %1 mm 處</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>connected to %n point(s)</source>
        <translation>
            <numerusform>與 %n 個點相連</numerusform>
        </translation>
    </message>
    <message>
        <source>Connected to points</source>
        <translation>與點相連</translation>
    </message>
    <message>
        <source>smoothed along edges</source>
        <translation>沿邊緣平滑</translation>
    </message>
    <message>
        <source>gradient, smoothed by %1 mm</source>
        <translation>梯度，平滑 %1 mm</translation>
    </message>
    <message>
        <source>sign changed</source>
        <translation>改變正負號</translation>
    </message>
    <message>
        <source>values %1</source>
        <translation>數值 %1</translation>
    </message>
    <message>
        <source>edges above %1</source>
        <translation>高於 %1 的邊緣</translation>
    </message>
    <message>
        <source>uniform density from %1</source>
        <translation>自 %1 起密度為一</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 至 %2</translation>
    </message>
</context>
<context>
    <name>StudyDetailsTexts</name>
    <message>
        <source>Series details</source>
        <translation>序列詳細資料</translation>
    </message>
    <message>
        <source>Patient</source>
        <translation>病患</translation>
    </message>
    <message>
        <source>Patient ID</source>
        <translation>病患識別碼</translation>
    </message>
    <message>
        <source>Date of birth</source>
        <translation>出生日期</translation>
    </message>
    <message>
        <source>Sex</source>
        <translation>性別</translation>
    </message>
    <message>
        <source>Study</source>
        <translation>檢查</translation>
    </message>
    <message>
        <source>Study UID</source>
        <translation>檢查 UID</translation>
    </message>
    <message>
        <source>Series</source>
        <translation>序列</translation>
    </message>
    <message>
        <source>Series UID</source>
        <translation>序列 UID</translation>
    </message>
    <message>
        <source>Modality</source>
        <translation>儀器類別</translation>
    </message>
    <message>
        <source>Body part</source>
        <translation>部位</translation>
    </message>
    <message>
        <source>Slices, rows, columns</source>
        <translation>切片、列、行</translation>
    </message>
    <message>
        <source>Pixel spacing</source>
        <translation>像素間距</translation>
    </message>
    <message>
        <source>Slice spacing</source>
        <translation>切片間距</translation>
    </message>
    <message>
        <source>%1 mm</source>
        <translation>%1 mm</translation>
    </message>
    <message>
        <source>Tilt</source>
        <translation>傾斜</translation>
    </message>
    <message>
        <source>%1 degrees</source>
        <translation>%1 度</translation>
    </message>
    <message>
        <source>Files</source>
        <translation>檔案</translation>
    </message>
    <message>
        <source>%1, copied into the library</source>
        <translation>%1 個，已複製到資料庫</translation>
    </message>
    <message>
        <source>%1, referenced in place</source>
        <translation>%1 個，參照原處</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>資料夾</translation>
    </message>
</context>
<context>
    <name>StudyFactsTexts</name>
    <message>
        <source>Unnamed</source>
        <translation>未具名</translation>
    </message>
    <message>
        <source>Study</source>
        <translation>檢查</translation>
    </message>
    <message>
        <source>Phantoms</source>
        <translation>假體</translation>
    </message>
    <message>
        <source>Files</source>
        <translation>檔案</translation>
    </message>
    <message>
        <source>Volume files</source>
        <translation>體積檔案</translation>
    </message>
    <message numerus="yes">
        <source>%n phases</source>
        <translation>
            <numerusform>%n 個時相</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>StudySourceTexts</name>
    <message>
        <source>Made by Pellucid</source>
        <translation>由 Pellucid 產生</translation>
    </message>
    <message>
        <source>Head phantom</source>
        <translation>頭部假體</translation>
    </message>
    <message>
        <source>Chest phantom</source>
        <translation>胸部假體</translation>
    </message>
</context>
<context>
    <name>ToneTool</name>
    <message>
        <source>Projection window</source>
        <translation>投影的窗</translation>
    </message>
</context>
<context>
    <name>ToolBarTexts</name>
    <message>
        <source>Tools</source>
        <translation>工具</translation>
    </message>
    <message>
        <source>Window presets of the planes</source>
        <translation>切面的窗預設值</translation>
    </message>
    <message>
        <source>More</source>
        <translation>更多</translation>
    </message>
    <message>
        <source>Window width / center of the planes (keys 0 to 9)</source>
        <translation>切面的窗寬／窗位（按鍵 0 至 9）</translation>
    </message>
    <message>
        <source>View</source>
        <translation>檢視</translation>
    </message>
    <message>
        <source>Standard views and C-arm angles</source>
        <translation>標準檢視與 C 臂角度</translation>
    </message>
</context>
<context>
    <name>ToolCommands</name>
    <message>
        <source>Window</source>
        <translation>窗</translation>
    </message>
    <message>
        <source>drag for width and center</source>
        <translation>拖曳調整窗寬與窗位</translation>
    </message>
    <message>
        <source>Pan</source>
        <translation>平移</translation>
    </message>
    <message>
        <source>drag the picture</source>
        <translation>拖曳影像</translation>
    </message>
    <message>
        <source>Zoom</source>
        <translation>縮放</translation>
    </message>
    <message>
        <source>drag up and down</source>
        <translation>上下拖曳</translation>
    </message>
    <message>
        <source>Crosshair</source>
        <translation>十字線</translation>
    </message>
    <message>
        <source>drag the crosshair; its dots turn the planes</source>
        <translation>拖曳十字線；其圓點可旋轉切面</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>距離</translation>
    </message>
    <message>
        <source>drag a line, also in the projection</source>
        <translation>拖曳一條線；投影中亦可</translation>
    </message>
    <message>
        <source>Polyline</source>
        <translation>折線</translation>
    </message>
    <message>
        <source>click its corners; a double-click ends it</source>
        <translation>點按各轉折點；按兩下結束</translation>
    </message>
    <message>
        <source>Angle</source>
        <translation>角度</translation>
    </message>
    <message>
        <source>drag one leg, click the end of the other</source>
        <translation>拖曳一邊，再點按另一邊的端點</translation>
    </message>
    <message>
        <source>Cobb angle</source>
        <translation>Cobb 角</translation>
    </message>
    <message>
        <source>drag a line along each of two end plates</source>
        <translation>沿兩個終板各拖曳一條線</translation>
    </message>
    <message>
        <source>Ellipse</source>
        <translation>橢圓</translation>
    </message>
    <message>
        <source>drag its bounding box</source>
        <translation>拖曳外框</translation>
    </message>
    <message>
        <source>Rectangle</source>
        <translation>矩形</translation>
    </message>
    <message>
        <source>drag from corner to corner</source>
        <translation>由一角拖曳至另一角</translation>
    </message>
    <message>
        <source>Arrow</source>
        <translation>箭頭</translation>
    </message>
    <message>
        <source>drag from the structure it points to, to where the text goes</source>
        <translation>由所指之處拖曳至文字處</translation>
    </message>
    <message>
        <source>Text</source>
        <translation>文字</translation>
    </message>
    <message>
        <source>click where it begins; a double-click changes it</source>
        <translation>點按起始處；按兩下可變更</translation>
    </message>
    <message>
        <source>Crop</source>
        <translation>裁切</translation>
    </message>
    <message>
        <source>drag the sides of the box in the planes</source>
        <translation>在切面中拖曳方框的各邊</translation>
    </message>
    <message>
        <source>Connected</source>
        <translation>相連</translation>
    </message>
    <message>
        <source>click connected tissue of similar values, also in the projection</source>
        <translation>點按數值相近且相連的組織，投影中亦可</translation>
    </message>
    <message>
        <source>Paint</source>
        <translation>塗畫</translation>
    </message>
    <message>
        <source>paint a region with a brush; Shift erases</source>
        <translation>以畫筆塗畫區域；Shift 擦除</translation>
    </message>
    <message>
        <source>Scissors</source>
        <translation>剪刀</translation>
    </message>
    <message>
        <source>draw around the part to cut along the line of sight</source>
        <translation>圍出沿視線剪裁的部分</translation>
    </message>
    <message>
        <source>Slab</source>
        <translation>厚切</translation>
    </message>
    <message>
        <source>Slab thickness, mm</source>
        <translation>厚切的厚度，mm</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>&amp;Slab</source>
        <translation>厚切(&amp;S)</translation>
    </message>
    <message>
        <source>Slab: give the planes a thickness; [ and ] change it</source>
        <translation>厚切：使切面具有厚度；以 [ 與 ] 變更</translation>
    </message>
    <message>
        <source>&amp;Mean</source>
        <translation>平均(&amp;M)</translation>
    </message>
    <message>
        <source>M&amp;aximum (MIP)</source>
        <translation>最大值 (MIP)(&amp;A)</translation>
    </message>
    <message>
        <source>M&amp;inimum (MinIP)</source>
        <translation>最小值 (MinIP)(&amp;I)</translation>
    </message>
    <message>
        <source>%1 mm</source>
        <translation>%1 mm</translation>
    </message>
    <message>
        <source>&amp;Other thickness...</source>
        <translation>其他厚度(&amp;O)…</translation>
    </message>
    <message>
        <source>T&amp;hicker</source>
        <translation>加厚(&amp;H)</translation>
    </message>
    <message>
        <source>Thi&amp;nner</source>
        <translation>減薄(&amp;N)</translation>
    </message>
    <message>
        <source>&amp;Linear</source>
        <translation>線性(&amp;L)</translation>
    </message>
    <message>
        <source>&amp;Nearest sample</source>
        <translation>最近取樣(&amp;N)</translation>
    </message>
    <message>
        <source>S&amp;how the whole volume</source>
        <translation>顯示整個體積(&amp;H)</translation>
    </message>
    <message>
        <source>Whole volume</source>
        <translation>整個體積</translation>
    </message>
    <message>
        <source>S&amp;traighten the planes</source>
        <translation>回正切面(&amp;T)</translation>
    </message>
    <message>
        <source>Straighten the planes</source>
        <translation>扶正切面</translation>
    </message>
    <message>
        <source>A&amp;lign the planes with the scan</source>
        <translation>使切面與掃描對齊(&amp;L)</translation>
    </message>
    <message>
        <source>Align the planes with the scan</source>
        <translation>使切面與掃描對齊</translation>
    </message>
    <message>
        <source>&amp;Grow...</source>
        <translation>擴張(&amp;G)…</translation>
    </message>
    <message>
        <source>Grow</source>
        <translation>擴張</translation>
    </message>
    <message>
        <source>Grow the class by, mm</source>
        <translation>類別擴張，mm</translation>
    </message>
    <message>
        <source>&amp;Shrink...</source>
        <translation>收縮(&amp;S)…</translation>
    </message>
    <message>
        <source>Shrink</source>
        <translation>收縮</translation>
    </message>
    <message>
        <source>Shrink the class by, mm</source>
        <translation>類別收縮，mm</translation>
    </message>
    <message>
        <source>&amp;Fill holes</source>
        <translation>填滿孔洞(&amp;F)</translation>
    </message>
    <message>
        <source>Fill holes</source>
        <translation>填滿孔洞</translation>
    </message>
    <message>
        <source>&amp;Largest part</source>
        <translation>最大部分(&amp;L)</translation>
    </message>
    <message>
        <source>Largest part</source>
        <translation>最大部分</translation>
    </message>
    <message>
        <source>Class &amp;volumes...</source>
        <translation>類別體積(&amp;V)…</translation>
    </message>
    <message>
        <source>Remove connected &amp;bone</source>
        <translation>移除相連的骨骼(&amp;B)</translation>
    </message>
    <message>
        <source>Pla&amp;y</source>
        <translation>播放(&amp;Y)</translation>
    </message>
    <message>
        <source>Play the slices of the plane, or turn the projection around the patient</source>
        <translation>播放切面的切片，或繞病患旋轉投影</translation>
    </message>
    <message>
        <source>%1 frames per second</source>
        <translation>每秒 %1 張</translation>
    </message>
    <message>
        <source>&amp;Next phase</source>
        <translation>下一時相(&amp;N)</translation>
    </message>
    <message>
        <source>P&amp;revious phase</source>
        <translation>上一時相(&amp;R)</translation>
    </message>
    <message>
        <source>Play p&amp;hases</source>
        <translation>播放時相(&amp;H)</translation>
    </message>
    <message>
        <source>&amp;Region</source>
        <translation>區域(&amp;R)</translation>
    </message>
    <message>
        <source>Plane &amp;interpolation</source>
        <translation>切面內插(&amp;I)</translation>
    </message>
    <message>
        <source>S&amp;peed</source>
        <translation>速度(&amp;P)</translation>
    </message>
    <message>
        <source>&amp;Tools</source>
        <translation>工具(&amp;T)</translation>
    </message>
</context>
<context>
    <name>ViewCommands</name>
    <message>
        <source>Reset views</source>
        <translation>重設檢視</translation>
    </message>
    <message>
        <source>&amp;Anterior</source>
        <translation>前方(&amp;A)</translation>
    </message>
    <message>
        <source>Keypad 1</source>
        <translation>數字鍵 1</translation>
    </message>
    <message>
        <source>&amp;Posterior</source>
        <translation>後方(&amp;P)</translation>
    </message>
    <message>
        <source>Shift+Keypad 1</source>
        <translation>Shift+數字鍵 1</translation>
    </message>
    <message>
        <source>&amp;Left</source>
        <translation>左側(&amp;L)</translation>
    </message>
    <message>
        <source>Keypad 3</source>
        <translation>數字鍵 3</translation>
    </message>
    <message>
        <source>&amp;Right</source>
        <translation>右側(&amp;R)</translation>
    </message>
    <message>
        <source>Shift+Keypad 3</source>
        <translation>Shift+數字鍵 3</translation>
    </message>
    <message>
        <source>&amp;Superior</source>
        <translation>上方(&amp;S)</translation>
    </message>
    <message>
        <source>Keypad 7</source>
        <translation>數字鍵 7</translation>
    </message>
    <message>
        <source>&amp;Inferior</source>
        <translation>下方(&amp;I)</translation>
    </message>
    <message>
        <source>Shift+Keypad 7</source>
        <translation>Shift+數字鍵 7</translation>
    </message>
    <message>
        <source>C-arm an&amp;gles...</source>
        <translation>C 臂角度(&amp;G)…</translation>
    </message>
    <message>
        <source>R&amp;eset views</source>
        <translation>重設檢視(&amp;E)</translation>
    </message>
    <message>
        <source>Keypad 0</source>
        <translation>數字鍵 0</translation>
    </message>
    <message>
        <source>&amp;Orbit about the crosshair</source>
        <translation>繞十字線旋轉(&amp;O)</translation>
    </message>
    <message>
        <source>&amp;Free rotation (trackball)</source>
        <translation>自由旋轉（軌跡球）(&amp;F)</translation>
    </message>
    <message>
        <source>&amp;Tint segments in the planes</source>
        <translation>切面對分割區著色(&amp;T)</translation>
    </message>
    <message>
        <source>&amp;Compare with previous look</source>
        <translation>與前一個外觀比較(&amp;C)</translation>
    </message>
    <message>
        <source>hold Q</source>
        <translation>按住 Q</translation>
    </message>
    <message>
        <source>A&amp;nnotations</source>
        <translation>註記(&amp;N)</translation>
    </message>
    <message>
        <source>Cross&amp;hair</source>
        <translation>十字線(&amp;H)</translation>
    </message>
    <message>
        <source>Patient &amp;banner</source>
        <translation>病患橫幅(&amp;B)</translation>
    </message>
    <message>
        <source>Lin&amp;k views</source>
        <translation>連結檢視(&amp;K)</translation>
    </message>
    <message>
        <source>Close secon&amp;d study</source>
        <translation>關閉第二個檢查(&amp;D)</translation>
    </message>
    <message>
        <source>Recompute pro&amp;jection</source>
        <translation>重新計算投影(&amp;J)</translation>
    </message>
    <message>
        <source>&amp;Automatic</source>
        <translation>自動(&amp;A)</translation>
    </message>
    <message>
        <source>&amp;Processor</source>
        <translation>處理器(&amp;P)</translation>
    </message>
    <message>
        <source>&amp;Graphics card</source>
        <translation>顯示卡(&amp;G)</translation>
    </message>
    <message>
        <source>&amp;Full screen</source>
        <translation>全螢幕(&amp;F)</translation>
    </message>
    <message>
        <source>One large pane, three small</source>
        <translation>一大三小窗格</translation>
    </message>
    <message>
        <source>Four equal panes</source>
        <translation>四個等大窗格</translation>
    </message>
</context>
<context>
    <name>overlay</name>
    <message>
        <source>%1 ms</source>
        <translation>%1 毫秒</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::AngleDialog</name>
    <message>
        <source>C-arm angles</source>
        <translation>C 臂角度</translation>
    </message>
    <message>
        <source>Common angulations</source>
        <translation>常用角度</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>LAO / RAO</source>
        <translation>LAO／RAO</translation>
    </message>
    <message>
        <source>Cranial / caudal</source>
        <translation>頭側／足側</translation>
    </message>
    <message>
        <source>Rotation of the detector toward the patient&apos;s left (LAO) or right (RAO)</source>
        <translation>偵測器轉向病患左側（LAO）或右側（RAO）的角度</translation>
    </message>
    <message>
        <source>Tilt of the detector toward the head (CRA) or the feet (CAU)</source>
        <translation>偵測器傾向頭部（CRA）或足部（CAU）的角度</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::CardCopier</name>
    <message>
        <source>Copying to the graphics card</source>
        <translation>正在複製到顯示卡</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ClassDialog</name>
    <message>
        <source>Class</source>
        <translation>類別</translation>
    </message>
    <message>
        <source>Width of the soft edge at both ends of the range</source>
        <translation>範圍兩端柔和邊緣的寬度</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名稱</translation>
    </message>
    <message>
        <source>From</source>
        <translation>起</translation>
    </message>
    <message>
        <source>To</source>
        <translation>迄</translation>
    </message>
    <message>
        <source>Softness</source>
        <translation>柔和度</translation>
    </message>
    <message>
        <source>Color</source>
        <translation>顏色</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>步驟</translation>
    </message>
    <message>
        <source> samples</source>
        <translation> 個取樣</translation>
    </message>
    <message>
        <source>Soft edge</source>
        <translation>柔和邊緣</translation>
    </message>
    <message>
        <source>The values of the volume</source>
        <translation>體積的數值</translation>
    </message>
    <message>
        <source>Segment %1</source>
        <translation>分割區 %1</translation>
    </message>
    <message>
        <source>Source</source>
        <translation>來源</translation>
    </message>
    <message>
        <source>What the class consists of before its steps</source>
        <translation>類別在其步驟之前的內容</translation>
    </message>
    <message>
        <source>Smooths the edge of a region to avoid ringing</source>
        <translation>使範圍的邊緣平滑，以免產生波紋</translation>
    </message>
    <message>
        <source>Empty (add strokes or classes later)</source>
        <translation>空白（稍後加入筆畫或類別）</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ClassGroup</name>
    <message>
        <source>Fold %1</source>
        <translation>收合 %1</translation>
    </message>
    <message>
        <source>Show or hide all classes of this group that the list shows</source>
        <translation>顯示或隱藏清單所列此群組的所有類別</translation>
    </message>
    <message>
        <source>Show %1</source>
        <translation>顯示 %1</translation>
    </message>
    <message>
        <source>%1: %2 of %3</source>
        <translation>%1：%2 / %3</translation>
    </message>
    <message>
        <source>Unfold %1</source>
        <translation>展開 %1</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ClassRow</name>
    <message>
        <source>Show or hide the class</source>
        <translation>顯示或隱藏此類別</translation>
    </message>
    <message>
        <source>Show %1</source>
        <translation>顯示%1</translation>
    </message>
    <message>
        <source>Weight of %1</source>
        <translation>%1的權重</translation>
    </message>
    <message>
        <source>Weight; double-click sets it to 1</source>
        <translation>權重；按兩下設為 1</translation>
    </message>
    <message>
        <source>%1 ml</source>
        <translation>%1 毫升</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ClassSteps</name>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Up</source>
        <translation>上移</translation>
    </message>
    <message>
        <source>Down</source>
        <translation>下移</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>步驟</translation>
    </message>
    <message>
        <source>Add step</source>
        <translation>新增步驟</translation>
    </message>
    <message>
        <source>Remove the selected step</source>
        <translation>移除所選步驟</translation>
    </message>
    <message>
        <source>Run the selected step earlier</source>
        <translation>所選步驟提前</translation>
    </message>
    <message>
        <source>Run the selected step later</source>
        <translation>所選步驟延後</translation>
    </message>
    <message>
        <source>Add a step after the others</source>
        <translation>在其他步驟之後新增步驟</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ClassVolumesDialog</name>
    <message>
        <source>Copy</source>
        <translation>複製</translation>
    </message>
    <message>
        <source>Save as...</source>
        <translation>另存新檔…</translation>
    </message>
    <message>
        <source>Volumes of the classes</source>
        <translation>類別的體積</translation>
    </message>
    <message>
        <source>Class</source>
        <translation>類別</translation>
    </message>
    <message>
        <source>Volume, ml</source>
        <translation>體積，ml</translation>
    </message>
    <message>
        <source>Mean</source>
        <translation>平均</translation>
    </message>
    <message>
        <source>SD</source>
        <translation>標準差</translation>
    </message>
    <message>
        <source>Minimum</source>
        <translation>最小值</translation>
    </message>
    <message>
        <source>Maximum</source>
        <translation>最大值</translation>
    </message>
    <message>
        <source>Measuring the classes</source>
        <translation>測量類別</translation>
    </message>
    <message>
        <source>Save the volumes</source>
        <translation>儲存體積</translation>
    </message>
    <message>
        <source>Table (*.csv)</source>
        <translation>表格 (*.csv)</translation>
    </message>
    <message>
        <source>Counts samples whose membership after all steps is 50 % or more.</source>
        <translation>計入經所有步驟後隸屬程度為 50 % 以上的取樣。</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ClassesPanel</name>
    <message>
        <source>Add class</source>
        <translation>新增類別</translation>
    </message>
    <message>
        <source>The transfer function applies to the whole volume. Add a class to show tissues separately.</source>
        <translation>轉換函數套用於整個體積。新增類別可將組織分開顯示。</translation>
    </message>
    <message>
        <source>Add a tissue class</source>
        <translation>新增組織類別</translation>
    </message>
    <message>
        <source>Weight</source>
        <translation>權重</translation>
    </message>
    <message>
        <source>Hide %1</source>
        <translation>隱藏%1</translation>
    </message>
    <message>
        <source>Show %1</source>
        <translation>顯示%1</translation>
    </message>
    <message>
        <source>Custom range</source>
        <translation>自訂範圍</translation>
    </message>
    <message>
        <source>Edit...</source>
        <translation>編輯…</translation>
    </message>
    <message>
        <source>Color...</source>
        <translation>顏色…</translation>
    </message>
    <message>
        <source>Show only this class</source>
        <translation>單獨顯示此類別</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Remove class</source>
        <translation>移除類別</translation>
    </message>
    <message>
        <source>Edit class</source>
        <translation>編輯類別</translation>
    </message>
    <message>
        <source>Color</source>
        <translation>顏色</translation>
    </message>
    <message>
        <source>Search classes</source>
        <translation>搜尋類別</translation>
    </message>
    <message>
        <source>Segments of %1</source>
        <translation>%1 的分割區</translation>
    </message>
    <message>
        <source>Open segmentation...</source>
        <translation>開啟分割檔...</translation>
    </message>
    <message>
        <source>Finds classes by their names and the terms of their codes</source>
        <translation>依名稱與代碼的用語尋找類別</translation>
    </message>
    <message>
        <source>Volumes...</source>
        <translation>體積…</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::CurveEditor</name>
    <message>
        <source>Transfer function</source>
        <translation>轉換函數</translation>
    </message>
    <message>
        <source>weight %1 at %2%3</source>
        <translation>%2%3 處的權重 %1</translation>
    </message>
    <message>
        <source>Drag a segment up or down; double-click resets it to 1. The wheel zooms the axis, a drag of the axis moves it, a double-click on it shows all values</source>
        <translation>上下拖曳線段；按兩下重設為 1。滾輪縮放座標軸，拖曳座標軸可移動，在其上按兩下則顯示所有數值</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::DepthCurve</name>
    <message>
        <source>Weight by depth, far to near</source>
        <translation>由遠至近的深度權重</translation>
    </message>
    <message>
        <source>Weight by depth, from far (left) to near (right); drag the points</source>
        <translation>深度權重，由遠（左）至近（右）；拖曳各點</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::DisplayWindowDialog</name>
    <message>
        <source>Add the current window</source>
        <translation>加入目前的窗</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Up</source>
        <translation>上移</translation>
    </message>
    <message>
        <source>Down</source>
        <translation>下移</translation>
    </message>
    <message>
        <source>Display window</source>
        <translation>顯示窗</translation>
    </message>
    <message>
        <source>Window presets</source>
        <translation>窗預設</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名稱</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>窗寬</translation>
    </message>
    <message>
        <source>Center</source>
        <translation>窗位</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>單位</translation>
    </message>
    <message>
        <source>Restore defaults</source>
        <translation>還原預設值</translation>
    </message>
    <message>
        <source>The first eight presets of a unit are on the keys 1 to 8. Key 0 sets the automatic window, key 9 the file&apos;s own.</source>
        <translation>每個單位的前八個預設在按鍵 1 至 8。按鍵 0 設定自動窗，按鍵 9 設定檔案本身的窗。</translation>
    </message>
    <message>
        <source>Presets</source>
        <translation>預設</translation>
    </message>
    <message>
        <source>Window %1</source>
        <translation>窗 %1</translation>
    </message>
    <message>
        <source>Window presets work only for HU and SUV: other values are not comparable between studies</source>
        <translation>窗預設值僅適用於 HU 與 SUV：其他數值在不同檢查之間無法比較</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::EarlierPanel</name>
    <message>
        <source>here</source>
        <translation>在本機</translation>
    </message>
    <message numerus="yes">
        <source>%1, %n images</source>
        <translation>
            <numerusform>%1，%n 張影像</numerusform>
        </translation>
    </message>
    <message>
        <source>none</source>
        <translation>無</translation>
    </message>
    <message>
        <source>the latest</source>
        <translation>最近一個</translation>
    </message>
    <message>
        <source>the latest two</source>
        <translation>最近兩個</translation>
    </message>
    <message>
        <source>the latest three</source>
        <translation>最近三個</translation>
    </message>
    <message>
        <source>Click to open it side by side</source>
        <translation>按一下以並排開啟</translation>
    </message>
    <message>
        <source>Searching...</source>
        <translation>尋找中…</translation>
    </message>
    <message>
        <source>No other study of this patient is known.</source>
        <translation>沒有此病人的其他檢查。</translation>
    </message>
    <message>
        <source>This study may belong to a different patient:
%1

Open it side by side?</source>
        <translation>此檢查可能屬於其他病人：
%1

要並排開啟嗎？</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>開啟</translation>
    </message>
    <message>
        <source>Prior studies</source>
        <translation>先前檢查</translation>
    </message>
    <message>
        <source>Retrieves the latest prior studies of the same modality when a study is opened</source>
        <translation>開啟檢查時，擷取同一儀器類別最近的先前檢查</translation>
    </message>
    <message>
        <source>Prefetch prior studies</source>
        <translation>預先取回先前檢查</translation>
    </message>
    <message>
        <source>Possibly a different patient</source>
        <translation>可能為其他病人</translation>
    </message>
    <message>
        <source>%1: more results than shown</source>
        <translation>%1：結果多於所顯示者</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::EarlierStudies</name>
    <message>
        <source>Looking for prior studies</source>
        <translation>尋找先前檢查</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ExportDialog</name>
    <message>
        <source>Axial</source>
        <translation>橫斷面</translation>
    </message>
    <message>
        <source>Coronal</source>
        <translation>冠狀面</translation>
    </message>
    <message>
        <source>Sagittal</source>
        <translation>矢狀面</translation>
    </message>
    <message>
        <source>Projection</source>
        <translation>投影</translation>
    </message>
    <message>
        <source>As it looks (PNG)</source>
        <translation>如畫面所見 (PNG)</translation>
    </message>
    <message>
        <source>Grey in 16 bits (PNG)</source>
        <translation>16 位元灰階 (PNG)</translation>
    </message>
    <message>
        <source>Values (NumPy, float)</source>
        <translation>數值 (NumPy，浮點)</translation>
    </message>
    <message>
        <source>Values (NRRD, float)</source>
        <translation>數值 (NRRD，浮點)</translation>
    </message>
    <message>
        <source>DICOM Secondary Capture</source>
        <translation>DICOM 二次擷取影像</translation>
    </message>
    <message>
        <source>Turntable, frames (PNG)</source>
        <translation>環繞一周，逐格 (PNG)</translation>
    </message>
    <message>
        <source>Turntable, video (MP4)</source>
        <translation>環繞一周，影片 (MP4)</translation>
    </message>
    <message>
        <source>With annotations</source>
        <translation>包含註記</translation>
    </message>
    <message>
        <source>Export picture</source>
        <translation>匯出影像</translation>
    </message>
    <message>
        <source>Names, letters, scale and measurements; without them the picture does not mark the patient&apos;s sides</source>
        <translation>名稱、方位字母、比例尺與測量；若不包含，影像上便沒有病患的左右標示</translation>
    </message>
    <message>
        <source>Pictures of one turn around the patient</source>
        <translation>環繞病患一周的影像張數</translation>
    </message>
    <message>
        <source>Browse...</source>
        <translation>瀏覽…</translation>
    </message>
    <message>
        <source>Picture of</source>
        <translation>影像來源</translation>
    </message>
    <message>
        <source>Format</source>
        <translation>格式</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>大小</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>張數</translation>
    </message>
    <message>
        <source>File</source>
        <translation>檔案</translation>
    </message>
    <message>
        <source>Write</source>
        <translation>寫入</translation>
    </message>
    <message>
        <source>%1 x %2 pixels</source>
        <translation>%1 x %2 像素</translation>
    </message>
    <message>
        <source>contains the patient&apos;s name and identifier</source>
        <translation>含有病患姓名與識別碼</translation>
    </message>
    <message>
        <source>one file for each frame, numbered</source>
        <translation>每格一個編號檔案</translation>
    </message>
    <message>
        <source>Writing</source>
        <translation>正在寫入</translation>
    </message>
    <message>
        <source>%1 already exists. Replace it?</source>
        <translation>%1 已經存在。要取代它嗎？</translation>
    </message>
    <message>
        <source>Without the patient&apos;s identity</source>
        <translation>不含病患身分</translation>
    </message>
    <message>
        <source>Removes the patient&apos;s name, ID, dates and study, and sets a new study UID (DICOM PS3.15, basic profile)</source>
        <translation>不含病患的姓名、編號、日期與檢查資料，並使用新的檢查 UID（DICOM PS3.15 基本設定檔）</translation>
    </message>
    <message>
        <source>does not identify the patient</source>
        <translation>不含任何病患身分資料</translation>
    </message>
    <message>
        <source>Patient</source>
        <translation>病患</translation>
    </message>
    <message>
        <source>The patient&apos;s name in annotations: choose one or type a pseudonym</source>
        <translation>註記中的病患姓名：選擇，或輸入代號</translation>
    </message>
    <message>
        <source>no name</source>
        <translation>無姓名</translation>
    </message>
    <message>
        <source>Turntable, DICOM (multi-frame)</source>
        <translation>環繞一周，DICOM（多格）</translation>
    </message>
    <message>
        <source>A file, or a server that stores DICOM pictures with the study</source>
        <translation>檔案，或將 DICOM 圖片與檢查一併保存的伺服器</translation>
    </message>
    <message>
        <source>To</source>
        <translation>至</translation>
    </message>
    <message>
        <source>Send</source>
        <translation>傳送</translation>
    </message>
    <message>
        <source>Sending to %1</source>
        <translation>正在傳送至 %1</translation>
    </message>
    <message>
        <source>Another export is running</source>
        <translation>另一個匯出正在執行</translation>
    </message>
    <message>
        <source>Save as recipe...</source>
        <translation>儲存為配方...</translation>
    </message>
    <message>
        <source>A file for pellucid-cli batch, which makes the same picture of many studies</source>
        <translation>供 pellucid-cli batch 使用的檔案，可對許多檢查產生相同的影像</translation>
    </message>
    <message>
        <source>Save as recipe</source>
        <translation>儲存為配方</translation>
    </message>
    <message>
        <source>Recipe (*.json)</source>
        <translation>配方 (*.json)</translation>
    </message>
    <message>
        <source>Saved to %1</source>
        <translation>已儲存至 %1</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>關閉</translation>
    </message>
    <message>
        <source>Replace</source>
        <translation>取代</translation>
    </message>
    <message>
        <source>Turntable video (MP4), needs ffmpeg</source>
        <translation>轉盤影片（MP4），需要 ffmpeg</translation>
    </message>
    <message>
        <source>Sent to %1</source>
        <translation>已傳送至 %1</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::FileActions</name>
    <message>
        <source>Open files</source>
        <translation>開啟檔案</translation>
    </message>
    <message>
        <source>Open segmentation</source>
        <translation>開啟分割檔</translation>
    </message>
    <message>
        <source>Open folder</source>
        <translation>開啟資料夾</translation>
    </message>
    <message>
        <source>Saved: %1</source>
        <translation>已儲存：%1</translation>
    </message>
    <message>
        <source>There is no projection to save yet</source>
        <translation>尚無投影可儲存</translation>
    </message>
    <message>
        <source>Save picture</source>
        <translation>儲存影像</translation>
    </message>
    <message>
        <source>PNG image (*.png)</source>
        <translation>PNG 影像 (*.png)</translation>
    </message>
    <message>
        <source>Sent to %1</source>
        <translation>已傳送至 %1</translation>
    </message>
    <message>
        <source>Copying the picture</source>
        <translation>正在複製影像</translation>
    </message>
    <message>
        <source>Copied the picture</source>
        <translation>已複製影像</translation>
    </message>
    <message>
        <source>Making the picture</source>
        <translation>正在製作影像</translation>
    </message>
    <message>
        <source>Pellucid, printed %1. Not for diagnostic use.</source>
        <translation>Pellucid，列印於 %1。不可用於診斷。</translation>
    </message>
    <message>
        <source>Print the picture</source>
        <translation>列印影像</translation>
    </message>
    <message>
        <source>Sent to the printer</source>
        <translation>已送至印表機</translation>
    </message>
    <message>
        <source>The printer is not available</source>
        <translation>印表機無法使用</translation>
    </message>
    <message>
        <source>There are no measurements to export yet</source>
        <translation>尚無測量可匯出</translation>
    </message>
    <message>
        <source>Export measurements</source>
        <translation>匯出測量</translation>
    </message>
    <message>
        <source>Table (*.csv)</source>
        <translation>表格 (*.csv)</translation>
    </message>
    <message>
        <source>There is no projection of this scene yet</source>
        <translation>此場景尚無投影</translation>
    </message>
    <message>
        <source>Save scene</source>
        <translation>儲存場景</translation>
    </message>
    <message>
        <source>Scene (*.json)</source>
        <translation>場景 (*.json)</translation>
    </message>
    <message>
        <source>There are no classes to save yet</source>
        <translation>尚無類別可儲存</translation>
    </message>
    <message>
        <source>Save classes as segmentation</source>
        <translation>將類別存為分割檔</translation>
    </message>
    <message>
        <source>DICOM segmentation (*.dcm);;Labels (*.nrrd)</source>
        <translation>DICOM 分割檔 (*.dcm);;標籤 (*.nrrd)</translation>
    </message>
    <message>
        <source>Writing %1</source>
        <translation>正在寫入 %1</translation>
    </message>
    <message>
        <source>Open scene</source>
        <translation>開啟場景</translation>
    </message>
    <message>
        <source>An export is running: wait until it ends before you copy or print</source>
        <translation>正在匯出：請待其結束後再複製或列印</translation>
    </message>
    <message>
        <source>Saved: %1; these classes are empty: %2</source>
        <translation>已儲存：%1；這些類別是空的：%2</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::GraphicsCard</name>
    <message>
        <source>Graphics card: %1</source>
        <translation>顯示卡：%1</translation>
    </message>
    <message>
        <source>Processor: %1</source>
        <translation>處理器：%1</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::HeaderDialog</name>
    <message>
        <source>DICOM header</source>
        <translation>DICOM 標頭</translation>
    </message>
    <message>
        <source>Search tags, names and values</source>
        <translation>搜尋標籤、名稱與值</translation>
    </message>
    <message>
        <source>Search the attributes</source>
        <translation>搜尋屬性</translation>
    </message>
    <message>
        <source> of %1</source>
        <translation>／%1</translation>
    </message>
    <message>
        <source>Number of the file</source>
        <translation>檔案編號</translation>
    </message>
    <message>
        <source>Attributes</source>
        <translation>屬性</translation>
    </message>
    <message>
        <source>Tag</source>
        <translation>標籤</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名稱</translation>
    </message>
    <message>
        <source>Type</source>
        <translation>類型</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>值</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>複製</translation>
    </message>
    <message>
        <source>Copy the selected attributes, or all that are listed (Ctrl+C)</source>
        <translation>複製所選的屬性，或列出的全部屬性 (Ctrl+C)</translation>
    </message>
    <message>
        <source>Reading %1</source>
        <translation>正在讀取 %1</translation>
    </message>
    <message>
        <source>Item %1</source>
        <translation>項目 %1</translation>
    </message>
    <message>
        <source>Nothing found</source>
        <translation>找不到</translation>
    </message>
    <message>
        <source>The list is not complete: the file has more attributes, or the rest of it is damaged.</source>
        <translation>清單不完整：檔案有更多屬性，或其餘部分已損壞。</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ImportDialog</name>
    <message>
        <source>&amp;Copy the files into the library</source>
        <translation>將檔案複製到資料庫(&amp;C)</translation>
    </message>
    <message>
        <source>Import into the library</source>
        <translation>匯入資料庫</translation>
    </message>
    <message>
        <source>Takes no space; the files must stay where they are</source>
        <translation>不佔空間；檔案必須留在原處</translation>
    </message>
    <message>
        <source>For discs and removable drives; archives are always copied</source>
        <translation>適用於光碟與可移除的磁碟；壓縮檔一律複製</translation>
    </message>
    <message>
        <source>Add &amp;files...</source>
        <translation>加入檔案(&amp;F)…</translation>
    </message>
    <message>
        <source>Add f&amp;older...</source>
        <translation>加入資料夾(&amp;O)…</translation>
    </message>
    <message>
        <source>Files to import</source>
        <translation>要匯入的檔案</translation>
    </message>
    <message>
        <source>Folder to import</source>
        <translation>要匯入的資料夾</translation>
    </message>
    <message>
        <source>Import</source>
        <translation>匯入</translation>
    </message>
    <message>
        <source>Choose files, folders, a DICOMDIR or ZIP archives. Folders are searched recursively.</source>
        <translation>請選擇檔案、資料夾、DICOMDIR 或 ZIP 壓縮檔。資料夾會連同所有子資料夾一併搜尋。</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Files and folders to import</source>
        <translation>要匯入的檔案與資料夾</translation>
    </message>
    <message>
        <source>Remove the selected files and folders from the list (Del)</source>
        <translation>將所選的檔案與資料夾移出清單 (Del)</translation>
    </message>
    <message>
        <source>&amp;Leave the files where they are</source>
        <translation>檔案留在原處(&amp;L)</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::JobStrip</name>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>Stop the running job (Esc)</source>
        <translation>停止進行中的工作 (Esc)</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::LightSphere</name>
    <message>
        <source>Light directions</source>
        <translation>光源方向</translation>
    </message>
    <message>
        <source>Drag a light over the sphere; beyond the rim, it shines from behind</source>
        <translation>在球面上拖曳光源；超出邊緣則由後方照射</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::LimitBox</name>
    <message>
        <source>no limit</source>
        <translation>不限</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::LoginDialog</name>
    <message>
        <source>&amp;Open the browser</source>
        <translation>開啟瀏覽器(&amp;O)</translation>
    </message>
    <message>
        <source>&amp;Copy the address</source>
        <translation>複製網址(&amp;C)</translation>
    </message>
    <message>
        <source>Log in to %1</source>
        <translation>登入 %1</translation>
    </message>
    <message>
        <source>The server %1 asks for a login in the browser.</source>
        <translation>伺服器 %1 要求在瀏覽器中登入。</translation>
    </message>
    <message>
        <source>Show the page of the login server in the browser</source>
        <translation>在瀏覽器中顯示登入伺服器的頁面</translation>
    </message>
    <message>
        <source>Copy the address of the page, for a different browser</source>
        <translation>複製頁面的網址，以便使用其他瀏覽器</translation>
    </message>
    <message>
        <source>Connecting...</source>
        <translation>正在連線…</translation>
    </message>
    <message>
        <source>You are logged in, and can close this window.</source>
        <translation>您已登入，可以關閉此視窗。</translation>
    </message>
    <message>
        <source>The login failed; you can close this window.</source>
        <translation>登入失敗，可以關閉此視窗。</translation>
    </message>
    <message>
        <source>Logging in to %1</source>
        <translation>正在登入 %1</translation>
    </message>
    <message>
        <source>Log in to %1 in the browser.</source>
        <translation>請在瀏覽器中登入 %1。</translation>
    </message>
    <message>
        <source>No browser could be opened. Copy the address, and open it in a browser on this computer.</source>
        <translation>無法開啟瀏覽器。請複製網址，並在本機的瀏覽器中開啟。</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::LookDocks</name>
    <message>
        <source>PRESETS</source>
        <translation>預設集</translation>
    </message>
    <message>
        <source>CLASSES</source>
        <translation>類別</translation>
    </message>
    <message>
        <source>TRANSFER FUNCTION</source>
        <translation>轉換函數</translation>
    </message>
    <message>
        <source>SHADING</source>
        <translation>明暗</translation>
    </message>
    <message>
        <source>QUALITY</source>
        <translation>品質</translation>
    </message>
    <message>
        <source>RADIOGRAPH</source>
        <translation>X 光影像</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::LookPreparer</name>
    <message>
        <source>Preparing the parts of the look</source>
        <translation>正在準備外觀的各部分</translation>
    </message>
    <message>
        <source>Preparing the projection</source>
        <translation>正在準備投影</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::MainWindow</name>
    <message>
        <source>There is no earlier look to compare with</source>
        <translation>沒有可比較的先前外觀</translation>
    </message>
    <message>
        <source>Saved: %1</source>
        <translation>已儲存：%1</translation>
    </message>
    <message>
        <source>Not protected</source>
        <translation>未受保護</translation>
    </message>
    <message>
        <source>Imported %1 series, %2 files; not used: %3</source>
        <translation>已匯入 %1 個序列、%2 個檔案；未使用：%3</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::MeasurementsPanel</name>
    <message>
        <source>Export</source>
        <translation>匯出</translation>
    </message>
    <message>
        <source>Measurements</source>
        <translation>測量</translation>
    </message>
    <message>
        <source>Export the measurements as a table (CSV)</source>
        <translation>將測量匯出為表格 (CSV)</translation>
    </message>
    <message>
        <source>Rename measurement</source>
        <translation>重新命名測量</translation>
    </message>
    <message>
        <source>Delete measurement</source>
        <translation>刪除測量</translation>
    </message>
    <message>
        <source>Drag distances, angles and regions in a plane. They are kept with the study.</source>
        <translation>在切面中拖曳出距離、角度與區域。它們隨檢查保存。</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::MprView</name>
    <message>
        <source>Images only: not a volume</source>
        <translation>僅有影像：不構成體積</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::PaneArea</name>
    <message>
        <source>Drag to resize the panes; double-click to restore the default sizes</source>
        <translation>拖曳以調整窗格大小；按兩下還原預設大小</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::PaneMenus</name>
    <message>
        <source>&amp;Tool</source>
        <translation>工具(&amp;T)</translation>
    </message>
    <message>
        <source>Show &amp;all panes</source>
        <translation>顯示所有窗格(&amp;A)</translation>
    </message>
    <message>
        <source>&amp;Maximize</source>
        <translation>最大化(&amp;M)</translation>
    </message>
    <message>
        <source>&amp;Delete</source>
        <translation>刪除(&amp;D)</translation>
    </message>
    <message>
        <source>&amp;Delete %1</source>
        <translation>刪除 %1(&amp;D)</translation>
    </message>
    <message>
        <source>Delete measurement</source>
        <translation>刪除測量</translation>
    </message>
    <message>
        <source>&amp;Reset the plane&apos;s view</source>
        <translation>重設切面的檢視(&amp;R)</translation>
    </message>
    <message>
        <source>&amp;Fit to the patient</source>
        <translation>符合病患大小(&amp;F)</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::PhaseBar</name>
    <message>
        <source>Play</source>
        <translation>播放</translation>
    </message>
    <message>
        <source>Play the phases (Shift+Space)</source>
        <translation>播放各時相 (Shift+空白鍵)</translation>
    </message>
    <message>
        <source>Phase</source>
        <translation>時相</translation>
    </message>
    <message>
        <source>Phase shown (keys , and .)</source>
        <translation>顯示的時相（按鍵 , 與 .）</translation>
    </message>
    <message>
        <source>Phase %1 of %2</source>
        <translation>時相 %1 / %2</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::PreferencesDialog</name>
    <message>
        <source>Preferences</source>
        <translation>偏好設定</translation>
    </message>
    <message>
        <source>General</source>
        <translation>一般</translation>
    </message>
    <message>
        <source>Keys</source>
        <translation>按鍵</translation>
    </message>
    <message>
        <source>System default</source>
        <translation>依系統</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>深色</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>淺色</translation>
    </message>
    <message>
        <source>Icons</source>
        <translation>圖示</translation>
    </message>
    <message>
        <source>Text</source>
        <translation>文字</translation>
    </message>
    <message>
        <source>Icons and text</source>
        <translation>圖示與文字</translation>
    </message>
    <message>
        <source>Remember opened studies</source>
        <translation>記住開啟過的檢查</translation>
    </message>
    <message>
        <source>Stores their paths and the last session on this computer</source>
        <translation>在這部電腦上記住其路徑與上次的工作階段</translation>
    </message>
    <message>
        <source>Reopen the last study at startup</source>
        <translation>啟動時重新開啟上次的檢查</translation>
    </message>
    <message>
        <source>Otherwise, the start page offers it</source>
        <translation>否則由起始頁提供</translation>
    </message>
    <message>
        <source>Show patient names in the window title and recent studies</source>
        <translation>在視窗標題與最近的檢查中顯示病患姓名</translation>
    </message>
    <message>
        <source>Window titles are visible in task bars and to other programs. If this is off, paths that name a patient are not remembered either</source>
        <translation>視窗標題會出現在工作列，也可被其他程式看見。未勾選時，含有病患姓名的路徑也不會被記住</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>語言</translation>
    </message>
    <message>
        <source>Theme</source>
        <translation>佈景主題</translation>
    </message>
    <message>
        <source>Tool bar</source>
        <translation>工具列</translation>
    </message>
    <message>
        <source>Search commands and keys</source>
        <translation>搜尋指令與按鍵</translation>
    </message>
    <message>
        <source>Commands and their keys</source>
        <translation>指令及其按鍵</translation>
    </message>
    <message>
        <source>Command</source>
        <translation>指令</translation>
    </message>
    <message>
        <source>Key</source>
        <translation>按鍵</translation>
    </message>
    <message>
        <source>Key of the selected command</source>
        <translation>所選指令的按鍵</translation>
    </message>
    <message>
        <source>Default</source>
        <translation>原來的按鍵</translation>
    </message>
    <message>
        <source>No key</source>
        <translation>不設按鍵</translation>
    </message>
    <message>
        <source>Restore all defaults</source>
        <translation>全部還原</translation>
    </message>
    <message>
        <source>%1 was taken from &quot;%2&quot;, which now has no key</source>
        <translation>%1 原為「%2」的按鍵，該指令現在沒有按鍵</translation>
    </message>
    <message>
        <source>%1 is reserved for the panes; choose a different key</source>
        <translation>%1 是各窗格固定的按鍵，請選其他按鍵</translation>
    </message>
    <message>
        <source>The language changes at the next start</source>
        <translation>語言於下次啟動時變更</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::PresetsPanel</name>
    <message>
        <source>Presets</source>
        <translation>預設集</translation>
    </message>
    <message>
        <source>Save look</source>
        <translation>儲存外觀</translation>
    </message>
    <message>
        <source>Save the current look as your own preset (Ctrl+S)</source>
        <translation>將目前的外觀存為自己的預設集 (Ctrl+S)</translation>
    </message>
    <message>
        <source>Name of the look</source>
        <translation>外觀名稱</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>儲存</translation>
    </message>
    <message>
        <source>%1 is not a preset: %2</source>
        <translation>%1 不是預設集：%2</translation>
    </message>
    <message>
        <source>Custom look</source>
        <translation>自訂外觀</translation>
    </message>
    <message>
        <source>Plain density</source>
        <translation>原始密度</translation>
    </message>
    <message>
        <source>Preset %1</source>
        <translation>預設集%1</translation>
    </message>
    <message>
        <source>Custom look %1</source>
        <translation>自訂外觀 %1</translation>
    </message>
    <message>
        <source>Import preset</source>
        <translation>匯入預設集</translation>
    </message>
    <message>
        <source>Presets and 3D Slicer volume properties (*.json *.vp)</source>
        <translation>預設集與 3D Slicer 體積屬性 (*.json *.vp)</translation>
    </message>
    <message>
        <source>&apos;%1&apos; was fitted; the largest error of its opacity is %2</source>
        <translation>已擬合「%1」；其不透明度的最大誤差為 %2</translation>
    </message>
    <message>
        <source>Export preset</source>
        <translation>匯出預設集</translation>
    </message>
    <message>
        <source>Preset (*.json)</source>
        <translation>預設集 (*.json)</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>刪除</translation>
    </message>
    <message>
        <source>All</source>
        <translation>全部</translation>
    </message>
    <message>
        <source>List all presets, not only those for the body region of the open study</source>
        <translation>列出所有預設集，而不只是適合目前檢查部位者</translation>
    </message>
    <message>
        <source>Open a study to see it with the presets.</source>
        <translation>開啟檢查，即可以預設集檢視。</translation>
    </message>
    <message>
        <source>Pictures without positions have no projection, and so no presets.</source>
        <translation>沒有位置的影像沒有投影，因此沒有預設集。</translation>
    </message>
    <message>
        <source>Delete preset %1</source>
        <translation>刪除預設集 %1</translation>
    </message>
    <message>
        <source>Delete preset</source>
        <translation>刪除預設集</translation>
    </message>
    <message>
        <source>Delete the preset %1? Undo brings it back as long as the study is open.</source>
        <translation>要刪除預設集 %1 嗎？只要檢查仍開啟，即可復原。</translation>
    </message>
    <message>
        <source>Delete...</source>
        <translation>刪除…</translation>
    </message>
    <message>
        <source>Delete (built-in presets cannot be deleted)</source>
        <translation>刪除（內建預設集不可刪除）</translation>
    </message>
    <message>
        <source>Points, strokes and cuts belong to this study and are not saved in the preset. When you apply it, it asks for new points.</source>
        <translation>點、筆畫與剪裁屬於此檢查，不會存入預設集。套用預設集時，會要求新的點。</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ProblemList</name>
    <message>
        <source>Problems</source>
        <translation>問題</translation>
    </message>
    <message>
        <source>Files not used, and why</source>
        <translation>未使用的檔案及原因</translation>
    </message>
    <message numerus="yes">
        <source>and %n more</source>
        <translation>
            <numerusform>及其他 %n 項</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n files: %1</source>
        <translation>
            <numerusform>%n 個檔案：%1</numerusform>
        </translation>
    </message>
    <message>
        <source>PROBLEMS (%1)</source>
        <translation>問題 (%1)</translation>
    </message>
    <message>
        <source>Clear</source>
        <translation>清除</translation>
    </message>
    <message>
        <source>Clear the list</source>
        <translation>清除清單</translation>
    </message>
    <message>
        <source>NOT USED</source>
        <translation>未使用</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ProjectionView</name>
    <message>
        <source>Projection</source>
        <translation>投影</translation>
    </message>
    <message>
        <source>Preparing the projection</source>
        <translation>正在準備投影</translation>
    </message>
    <message>
        <source>Cancelled: there is no projection</source>
        <translation>已取消：沒有投影</translation>
    </message>
    <message>
        <source>Reset window</source>
        <translation>重設窗</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::QualityPanel</name>
    <message>
        <source>More</source>
        <translation>更多</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>品質</translation>
    </message>
    <message>
        <source>Largest error allowed</source>
        <translation>容許的最大誤差</translation>
    </message>
    <message>
        <source>Draft</source>
        <translation>草圖</translation>
    </message>
    <message>
        <source>Interactive</source>
        <translation>互動</translation>
    </message>
    <message>
        <source>Standard</source>
        <translation>標準</translation>
    </message>
    <message>
        <source>Fine</source>
        <translation>精細</translation>
    </message>
    <message>
        <source>Custom</source>
        <translation>自訂</translation>
    </message>
    <message>
        <source>Tolerance</source>
        <translation>容差</translation>
    </message>
    <message>
        <source>Largest relative error of the picture: 0.0001 to 30 percent</source>
        <translation>影像的最大相對誤差：百分之 0.0001 至 30</translation>
    </message>
    <message>
        <source>Interpolation</source>
        <translation>內插</translation>
    </message>
    <message>
        <source>Interpolation between the samples of the volume</source>
        <translation>體積取樣之間的內插方式</translation>
    </message>
    <message>
        <source>Cubic</source>
        <translation>三次</translation>
    </message>
    <message>
        <source>Linear</source>
        <translation>線性</translation>
    </message>
    <message>
        <source>Sharp (band-limited)</source>
        <translation>銳利（頻帶限制）</translation>
    </message>
    <message>
        <source>Kernel</source>
        <translation>核函數</translation>
    </message>
    <message>
        <source>How the spectrum is interpolated</source>
        <translation>頻譜的內插方式</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>自動</translation>
    </message>
    <message>
        <source>Frame</source>
        <translation>影格</translation>
    </message>
    <message>
        <source>Time of the last frame</source>
        <translation>上一影格所需時間</translation>
    </message>
    <message>
        <source>Error</source>
        <translation>誤差</translation>
    </message>
    <message>
        <source>Plan</source>
        <translation>計畫</translation>
    </message>
    <message>
        <source>Kernel, storage and memory in use</source>
        <translation>使用中的核函數、儲存與記憶體</translation>
    </message>
    <message>
        <source>Override what the planner chose</source>
        <translation>手動取代計畫所選的項目</translation>
    </message>
    <message>
        <source>Reconstruction</source>
        <translation>重建</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not a tolerance: enter 0.0001 to 30 percent</source>
        <translation>「%1」不是容差：請輸入百分之 0.0001 至 30</translation>
    </message>
    <message>
        <source>%1, %2 bit, %3 MB</source>
        <translation>%1，%2 位元，%3 MB</translation>
    </message>
    <message>
        <source>A coarse picture first; the full one follows</source>
        <translation>先顯示粗略影像；完整影像隨後</translation>
    </message>
    <message>
        <source>The error exceeds the tolerance: %1</source>
        <translation>誤差超過容差：%1</translation>
    </message>
    <message>
        <source>Plan: %1</source>
        <translation>計畫：%1</translation>
    </message>
    <message>
        <source>%1, draft</source>
        <translation>%1，草圖</translation>
    </message>
    <message>
        <source>Spline</source>
        <translation>樣條</translation>
    </message>
    <message>
        <source>Predicted relative error of a picture of the whole volume from any direction; the projection shows the error of the current picture</source>
        <translation>預測的整體影像於任何方向的相對誤差；目前影像的誤差顯示於其旁</translation>
    </message>
    <message>
        <source>not known yet</source>
        <translation>尚未可知</translation>
    </message>
    <message>
        <source>at most %1</source>
        <translation>至多 %1</translation>
    </message>
    <message>
        <source>measured: %1</source>
        <translation>實測：%1</translation>
    </message>
    <message>
        <source>Preview while weights change</source>
        <translation>權重變更期間的預覽</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::RadiographPanel</name>
    <message>
        <source>Without couch</source>
        <translation>不含檢查床</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>自動</translation>
    </message>
    <message>
        <source>Choose detail and latitude from the study</source>
        <translation>依檢查選擇細節與寬容度</translation>
    </message>
    <message>
        <source>Detail</source>
        <translation>細節</translation>
    </message>
    <message>
        <source>Latitude</source>
        <translation>寬容度</translation>
    </message>
    <message>
        <source>Sharpness</source>
        <translation>銳利度</translation>
    </message>
    <message>
        <source>Amplifies fine structures by a linear filter, in exported values too; double-click: none</source>
        <translation>以線性濾波器放大細微構造，匯出的數值亦然；按兩下：無</translation>
    </message>
    <message>
        <source>Leave out the couch, head rests and clothes, in every preset</source>
        <translation>在每個預設集中去除檢查床、頭枕與衣物</translation>
    </message>
    <message>
        <source>Automatic contrast</source>
        <translation>自動對比</translation>
    </message>
    <message>
        <source>auto</source>
        <translation>自動</translation>
    </message>
    <message>
        <source>How strongly fine structures, such as trabeculae and vessels, are amplified; 0: unchanged. Double-click: automatic</source>
        <translation>放大骨小樑與血管等細微構造的程度；0：不變。按兩下：自動</translation>
    </message>
    <message>
        <source>Brings thick and thin parts to a similar brightness; 0: off. Double-click: automatic</source>
        <translation>使厚薄部位的亮度相近；0：關閉。按兩下：自動</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ReceiverForm</name>
    <message>
        <source>&amp;Receive what the DICOM servers in the list send</source>
        <translation>接收清單中 DICOM 伺服器所傳送的內容(&amp;R)</translation>
    </message>
    <message>
        <source>&amp;Encrypt connections (TLS)</source>
        <translation>將連線加密（TLS）(&amp;E)</translation>
    </message>
    <message>
        <source>&amp;Apply</source>
        <translation>套用(&amp;A)</translation>
    </message>
    <message>
        <source>The name under which servers send to this program</source>
        <translation>伺服器傳送至本程式時使用的名稱</translation>
    </message>
    <message>
        <source>The port that servers send to; usually 11112</source>
        <translation>伺服器傳送的目的連接埠；通常為 11112</translation>
    </message>
    <message>
        <source>Senders must then use TLS, too</source>
        <translation>傳送者也必須使用 TLS</translation>
    </message>
    <message>
        <source>AE title of this program</source>
        <translation>本程式的 AE 名稱</translation>
    </message>
    <message>
        <source>Port</source>
        <translation>連接埠</translation>
    </message>
    <message>
        <source>Certificate</source>
        <translation>憑證</translation>
    </message>
    <message>
        <source>Private key</source>
        <translation>私密金鑰</translation>
    </message>
    <message>
        <source>Private key of the certificate (PEM), without a password</source>
        <translation>憑證的私密金鑰（PEM），沒有密碼</translation>
    </message>
    <message>
        <source>Receiving is off</source>
        <translation>接收已關閉</translation>
    </message>
    <message numerus="yes">
        <source>%1 receives on port %2; %n objects have arrived</source>
        <translation>
            <numerusform>%1 於連接埠 %2 接收；已收到 %n 個物件</numerusform>
        </translation>
    </message>
    <message>
        <source>all addresses</source>
        <translation>所有位址</translation>
    </message>
    <message>
        <source>Receive only on this address of this computer, on the servers&apos; network</source>
        <translation>本電腦在伺服器所在網路上的位址，僅在該處接收</translation>
    </message>
    <message>
        <source>Listen on</source>
        <translation>接收位址</translation>
    </message>
    <message>
        <source>Certificates of the CAs that issued the senders&apos; certificates (PEM). Each sender&apos;s certificate must name its host or address</source>
        <translation>簽發傳送端憑證之憑證機構的憑證（PEM）；每份傳送端憑證須載明該傳送端的主機或位址</translation>
    </message>
    <message>
        <source>What arrives is added to the library. Other senders are rejected</source>
        <translation>收到的資料加入資料庫。拒絕其他傳送者</translation>
    </message>
    <message>
        <source>Certificate of this program (PEM)</source>
        <translation>本程式的憑證（PEM）</translation>
    </message>
    <message>
        <source>CA certificates</source>
        <translation>CA 憑證</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::RegionBar</name>
    <message>
        <source>Erase</source>
        <translation>擦除</translation>
    </message>
    <message>
        <source>Bone</source>
        <translation>骨骼</translation>
    </message>
    <message>
        <source>Use of the region</source>
        <translation>區域的用途</translation>
    </message>
    <message>
        <source>Classes that the region changes</source>
        <translation>區域所改變的類別</translation>
    </message>
    <message>
        <source>Leak limit</source>
        <translation>滲漏限度</translation>
    </message>
    <message>
        <source>Radius</source>
        <translation>半徑</translation>
    </message>
    <message>
        <source>Slab</source>
        <translation>厚切</translation>
    </message>
    <message>
        <source>Thickness of the cut, about the crosshair</source>
        <translation>十字線附近剪裁的厚度</translation>
    </message>
    <message>
        <source>Whole depth</source>
        <translation>整個深度</translation>
    </message>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
    <message>
        <source>in the whole volume</source>
        <translation>於整個體積</translation>
    </message>
    <message>
        <source>in %1</source>
        <translation>於 %1</translation>
    </message>
    <message>
        <source>in every class</source>
        <translation>於所有類別</translation>
    </message>
    <message>
        <source>New class</source>
        <translation>新類別</translation>
    </message>
    <message>
        <source>Add to the class</source>
        <translation>加入類別</translation>
    </message>
    <message>
        <source>Add a point</source>
        <translation>加入一點</translation>
    </message>
    <message>
        <source>Click a point of %1 in a plane or the projection</source>
        <translation>在切面或投影中點按%1的一點</translation>
    </message>
    <message>
        <source>Click bone in a plane or the projection</source>
        <translation>在切面或投影中點按骨骼</translation>
    </message>
    <message>
        <source>Click in a plane or the projection; drag up to include more values</source>
        <translation>在切面或投影中點按；向上拖曳接受更多數值</translation>
    </message>
    <message>
        <source>Drag in a plane or the projection</source>
        <translation>在切面或投影中拖曳</translation>
    </message>
    <message>
        <source>Searching...</source>
        <translation>尋找中…</translation>
    </message>
    <message>
        <source>%1 ml</source>
        <translation>%1 ml</translation>
    </message>
    <message>
        <source>What the region does to the classes</source>
        <translation>區域對類別的作用</translation>
    </message>
    <message>
        <source>The brush erases; hold Shift to paint</source>
        <translation>以畫筆擦除；按住 Shift 則塗畫</translation>
    </message>
    <message>
        <source>All bone connected to the click, with its marrow and rim; drag up for less dense bone</source>
        <translation>與點按處相連的所有骨骼，包含骨髓與邊緣；向上拖曳可納入較疏鬆的骨骼</translation>
    </message>
    <message>
        <source>Radius of the brush (Shift+wheel over a plane)</source>
        <translation>畫筆的半徑（在切面上 Shift+滾輪）</translation>
    </message>
    <message>
        <source>Keep only the region</source>
        <translation>僅保留此區域</translation>
    </message>
    <message>
        <source>Remove the region</source>
        <translation>移除此區域</translation>
    </message>
    <message>
        <source>Draw around the part to cut, in a plane or the projection</source>
        <translation>在切面或投影中圍出要剪裁的部分</translation>
    </message>
    <message>
        <source>Narrowest passage the region may grow through</source>
        <translation>範圍可通過的最窄開口</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::RegionFinder</name>
    <message>
        <source>Finding the region</source>
        <translation>正在尋找區域</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::SegmentOpener</name>
    <message>
        <source>Reading the segments of %1</source>
        <translation>正在讀取 %1 的分割區</translation>
    </message>
    <message>
        <source>Open segmentation</source>
        <translation>開啟分割檔</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ServerBook</name>
    <message>
        <source>Password of %1 at %2</source>
        <translation>%1 在 %2 的密碼</translation>
    </message>
    <message>
        <source>Token for %1</source>
        <translation>%1 的權杖</translation>
    </message>
    <message>
        <source>Password of the private key for %1</source>
        <translation>%1 的私密金鑰密碼</translation>
    </message>
    <message>
        <source>Server</source>
        <translation>伺服器</translation>
    </message>
    <message>
        <source>Logging in to %1</source>
        <translation>正在登入 %1</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ServerCommands</name>
    <message>
        <source>Another export is running</source>
        <translation>另一項匯出正在執行</translation>
    </message>
    <message>
        <source>Sending to %1</source>
        <translation>正在傳送至 %1</translation>
    </message>
    <message>
        <source>%1 of %2 sent to %3</source>
        <translation>已傳送 %1／%2 至 %3</translation>
    </message>
    <message>
        <source>There are no files to send</source>
        <translation>沒有可傳送的檔案</translation>
    </message>
    <message>
        <source>This study has no volume</source>
        <translation>此檢查沒有體積</translation>
    </message>
    <message>
        <source>Open a link</source>
        <translation>開啟連結</translation>
    </message>
    <message>
        <source>Another program asks to open a study from the server %1. Allow links to this server?</source>
        <translation>另一個程式要求開啟伺服器 %1 的檢查。允許連結至此伺服器嗎？</translation>
    </message>
    <message>
        <source>Allow</source>
        <translation>允許</translation>
    </message>
    <message>
        <source>Looking for a study</source>
        <translation>尋找檢查</translation>
    </message>
    <message>
        <source>Another patient</source>
        <translation>其他病人</translation>
    </message>
    <message>
        <source>The server lists the study for one patient, but images of it name another.

Listed: %1
Named: %2

The study is in the library. Open it?</source>
        <translation>伺服器清單上的病人與影像所載的病人不同。

清單：%1
影像：%2

檢查已在檢查庫中。要開啟嗎？</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>開啟</translation>
    </message>
    <message>
        <source>Corrected data</source>
        <translation>已更正的資料</translation>
    </message>
    <message>
        <source>Replace</source>
        <translation>取代</translation>
    </message>
    <message>
        <source>Study received</source>
        <translation>已收到檢查</translation>
    </message>
    <message numerus="yes">
        <source>The server has corrected this study since %n of its images were received:

%1

Retrieve these images again, and replace the copies on this computer?</source>
        <translation>
            <numerusform>此檢查的 %n 張影像接收後，伺服器更正了此檢查：

%1

是否重新取回這些影像，並取代本機上的複本？</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ServerSearch</name>
    <message>
        <source>Searching servers</source>
        <translation>正在搜尋伺服器</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ServerTargets</name>
    <message>
        <source>Servers to send to</source>
        <translation>可傳送的伺服器</translation>
    </message>
    <message>
        <source>Drop studies or files here to send them to %1</source>
        <translation>將檢查或檔案拖曳至此以傳送至 %1</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ServersDialog</name>
    <message>
        <source>&amp;Test</source>
        <translation>測試(&amp;T)</translation>
    </message>
    <message>
        <source>&amp;Save</source>
        <translation>儲存(&amp;S)</translation>
    </message>
    <message>
        <source>&amp;Remove</source>
        <translation>移除(&amp;R)</translation>
    </message>
    <message>
        <source>Servers</source>
        <translation>伺服器</translation>
    </message>
    <message>
        <source>&amp;New server</source>
        <translation>新增伺服器(&amp;N)</translation>
    </message>
    <message>
        <source>Connect step by step, and show the step that fails</source>
        <translation>逐步連線，並顯示失敗的步驟</translation>
    </message>
    <message>
        <source>The name under which the server is listed</source>
        <translation>伺服器在清單中的名稱</translation>
    </message>
    <message>
        <source>DICOM</source>
        <translation>DICOM</translation>
    </message>
    <message>
        <source>DICOMweb</source>
        <translation>DICOMweb</translation>
    </message>
    <message>
        <source>The server&apos;s AE title</source>
        <translation>伺服器的 AE 名稱</translation>
    </message>
    <message>
        <source>Name or address of the server</source>
        <translation>伺服器的名稱或位址</translation>
    </message>
    <message>
        <source>The server&apos;s port; usually 104 or 11112</source>
        <translation>伺服器的連接埠；通常為 104 或 11112</translation>
    </message>
    <message>
        <source>For example https://pacs.example.org/dicom-web</source>
        <translation>例如 https://pacs.example.org/dicom-web</translation>
    </message>
    <message>
        <source>This program&apos;s AE title, which the server must know</source>
        <translation>本程式的 AE 名稱，伺服器必須認得</translation>
    </message>
    <message>
        <source>C-GET brings images on the same connection. With C-MOVE, the server sends them to this program&apos;s port 11112</source>
        <translation>C-GET 在同一連線上取回影像。使用 C-MOVE 時，伺服器將影像傳送至本程式的連接埠 11112</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>自動</translation>
    </message>
    <message>
        <source>Character set, such as ISO_IR 100, if answers name none</source>
        <translation>未註明字元集之回應所用的字元集，例如 ISO_IR 100</translation>
    </message>
    <message>
        <source>&amp;Encrypt the connection (TLS)</source>
        <translation>將連線加密（TLS）(&amp;E)</translation>
    </message>
    <message>
        <source>None</source>
        <translation>無</translation>
    </message>
    <message>
        <source>User and password</source>
        <translation>使用者與密碼</translation>
    </message>
    <message>
        <source>Token</source>
        <translation>權杖</translation>
    </message>
    <message>
        <source>User name at the server</source>
        <translation>在伺服器的使用者名稱</translation>
    </message>
    <message>
        <source>Kept in the desktop&apos;s keychain, or for this run of the program</source>
        <translation>保存於桌面的金鑰圈，或僅供本次執行</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名稱</translation>
    </message>
    <message>
        <source>Protocol</source>
        <translation>通訊協定</translation>
    </message>
    <message>
        <source>AE title</source>
        <translation>AE 名稱</translation>
    </message>
    <message>
        <source>Host</source>
        <translation>主機</translation>
    </message>
    <message>
        <source>Port</source>
        <translation>連接埠</translation>
    </message>
    <message>
        <source>URL</source>
        <translation>網址</translation>
    </message>
    <message>
        <source>Retrieve</source>
        <translation>取回</translation>
    </message>
    <message>
        <source>Connections</source>
        <translation>連線數</translation>
    </message>
    <message>
        <source>Character set</source>
        <translation>字元集</translation>
    </message>
    <message>
        <source>Certificates that are trusted (PEM); empty: those of the system</source>
        <translation>信任的憑證（PEM）；留空：系統的憑證</translation>
    </message>
    <message>
        <source>Certificate</source>
        <translation>憑證</translation>
    </message>
    <message>
        <source>Private key</source>
        <translation>私密金鑰</translation>
    </message>
    <message>
        <source>Private key of the certificate (PEM)</source>
        <translation>憑證的私密金鑰（PEM）</translation>
    </message>
    <message>
        <source>Key password</source>
        <translation>金鑰密碼</translation>
    </message>
    <message>
        <source>Login</source>
        <translation>登入</translation>
    </message>
    <message>
        <source>User</source>
        <translation>使用者</translation>
    </message>
    <message>
        <source>Password or token</source>
        <translation>密碼或權杖</translation>
    </message>
    <message>
        <source>unchanged</source>
        <translation>不變</translation>
    </message>
    <message>
        <source>Saved</source>
        <translation>已儲存</translation>
    </message>
    <message>
        <source>Connecting...</source>
        <translation>連線中…</translation>
    </message>
    <message>
        <source>Association</source>
        <translation>連結</translation>
    </message>
    <message>
        <source>Offers</source>
        <translation>提供</translation>
    </message>
    <message>
        <source>Testing %1</source>
        <translation>正在測試 %1</translation>
    </message>
    <message>
        <source>AE title of this program</source>
        <translation>本程式的 AE 名稱</translation>
    </message>
    <message>
        <source>Receiving</source>
        <translation>接收</translation>
    </message>
    <message>
        <source>Decompresses images before sending if the server does not accept their encoding</source>
        <translation>若伺服器不接受壓縮影像的編碼，則解壓縮後傳送</translation>
    </message>
    <message>
        <source>In the browser (OAuth 2.0)</source>
        <translation>在瀏覽器中（OAuth 2.0）</translation>
    </message>
    <message>
        <source>For example https://login.example.org/realms/hospital; the login server describes the other addresses there</source>
        <translation>例如 https://login.example.org/realms/hospital；登入伺服器在此說明其他網址</translation>
    </message>
    <message>
        <source>Page on which users log in; only without an issuer</source>
        <translation>使用者登入的頁面；僅在沒有發行者時需要</translation>
    </message>
    <message>
        <source>Issuer</source>
        <translation>發行者</translation>
    </message>
    <message>
        <source>Authorization URL</source>
        <translation>授權網址</translation>
    </message>
    <message>
        <source>Token URL</source>
        <translation>權杖網址</translation>
    </message>
    <message>
        <source>Client ID</source>
        <translation>用戶端識別碼</translation>
    </message>
    <message>
        <source>Scope</source>
        <translation>範圍</translation>
    </message>
    <message>
        <source>Login without TLS</source>
        <translation>未使用 TLS 的登入</translation>
    </message>
    <message>
        <source>Without TLS, others on the network can read the password or token for %1. Send it without TLS?</source>
        <translation>未使用 TLS 時，網路上的其他人可讀取 %1 的密碼或權杖。是否仍要在未使用 TLS 下傳送？</translation>
    </message>
    <message>
        <source>Send without TLS</source>
        <translation>在未使用 TLS 下傳送</translation>
    </message>
    <message>
        <source>Other hosts from which it sends with C-MOVE, such as the nodes of a cluster, separated by commas; usually empty</source>
        <translation>以 C-MOVE 傳送的其他主機，例如叢集的節點，以逗號分隔；通常留空</translation>
    </message>
    <message>
        <source>Sends from</source>
        <translation>傳送來源</translation>
    </message>
    <message>
        <source>Maximum number of results; 0: no limit</source>
        <translation>結果的數目上限；0：不限</translation>
    </message>
    <message>
        <source>&amp;Decompress if the encoding is not accepted</source>
        <translation>不接受該編碼時解壓縮(&amp;D)</translation>
    </message>
    <message>
        <source>Token endpoint; only without an issuer</source>
        <translation>權杖端點；僅在沒有簽發者時填寫</translation>
    </message>
    <message>
        <source>Client ID registered for Pellucid</source>
        <translation>為 Pellucid 註冊的用戶端 ID</translation>
    </message>
    <message>
        <source>Scopes to request, such as openid offline_access; optional</source>
        <translation>要求的範圍，例如 openid offline_access；選填</translation>
    </message>
    <message>
        <source>Maximum results</source>
        <translation>結果上限</translation>
    </message>
    <message>
        <source>Client certificate (PEM); empty: none</source>
        <translation>用戶端憑證（PEM）；空白：無</translation>
    </message>
    <message>
        <source>CA certificates</source>
        <translation>CA 憑證</translation>
    </message>
    <message>
        <source>Maximum number of simultaneous connections for retrieving; fewer are used if more would not save time</source>
        <translation>取回時同時連線的最大數目；若更多連線並不省時，則較少</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::ShadingPanel</name>
    <message>
        <source>Reset</source>
        <translation>重設</translation>
    </message>
    <message>
        <source>Remove the depth cue and all lights</source>
        <translation>移除深度提示與所有光源</translation>
    </message>
    <message>
        <source>Add light</source>
        <translation>新增光源</translation>
    </message>
    <message>
        <source>Add a light</source>
        <translation>新增光源</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Remove the selected light</source>
        <translation>移除所選光源</translation>
    </message>
    <message>
        <source>Color of the selected light</source>
        <translation>所選光源的顏色</translation>
    </message>
    <message>
        <source>Follows viewer</source>
        <translation>跟隨觀看者</translation>
    </message>
    <message>
        <source>Depth cue</source>
        <translation>深度提示</translation>
    </message>
    <message>
        <source>No depth cue</source>
        <translation>無深度提示</translation>
    </message>
    <message>
        <source>Linear cue</source>
        <translation>線性提示</translation>
    </message>
    <message>
        <source>Sine cue</source>
        <translation>正弦提示</translation>
    </message>
    <message>
        <source>Custom curve</source>
        <translation>自訂曲線</translation>
    </message>
    <message>
        <source>Strength of the depth cue</source>
        <translation>深度提示的強度</translation>
    </message>
    <message>
        <source>Strength of the depth cue; double-click sets it to 0.6</source>
        <translation>深度提示的強度；按兩下設為 0.6</translation>
    </message>
    <message>
        <source>Strength of the light</source>
        <translation>光源的強度</translation>
    </message>
    <message>
        <source>Strength of the selected light; double-click sets it to 0.8</source>
        <translation>所選光源的強度；按兩下設為 0.8</translation>
    </message>
    <message>
        <source>Ambient light</source>
        <translation>環境光</translation>
    </message>
    <message>
        <source>Number of curve values</source>
        <translation>曲線數值的個數</translation>
    </message>
    <message>
        <source>The selected light follows the viewer; otherwise, it stays with the patient</source>
        <translation>所選光源跟隨觀看者；否則固定於病患</translation>
    </message>
    <message>
        <source>Light color</source>
        <translation>光源的顏色</translation>
    </message>
    <message>
        <source>Cue</source>
        <translation>提示</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>光源</translation>
    </message>
    <message>
        <source>Ambient</source>
        <translation>環境</translation>
    </message>
    <message>
        <source>Remove light</source>
        <translation>移除光源</translation>
    </message>
    <message>
        <source>Reset shading</source>
        <translation>重設明暗</translation>
    </message>
    <message>
        <source>Light follows viewer or patient</source>
        <translation>光源跟隨觀看者或病患</translation>
    </message>
    <message>
        <source>Light direction</source>
        <translation>光源的方向</translation>
    </message>
    <message>
        <source>Points of the curve; more points render slower</source>
        <translation>曲線的點數；點越多，計算越慢</translation>
    </message>
    <message>
        <source>How much near structures stand out from far ones</source>
        <translation>近處構造比遠處突出的程度</translation>
    </message>
    <message>
        <source>How bright the body is without the lights; double-click sets it to 1</source>
        <translation>沒有光源時身體的亮度；按兩下設為 1</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::StartPage</name>
    <message>
        <source>Continue where you left off</source>
        <translation>從上次結束處繼續</translation>
    </message>
    <message>
        <source>Reopens the last study as you left it</source>
        <translation>重新開啟上次的檢查，並恢復您離開時的狀態</translation>
    </message>
    <message>
        <source>Open a study</source>
        <translation>開啟檢查</translation>
    </message>
    <message>
        <source>Drop DICOM files, folders, a DICOMDIR, a ZIP archive or a volume (NRRD, NIfTI, MetaImage) anywhere in this window.</source>
        <translation>請將 DICOM 檔案、資料夾、DICOMDIR、ZIP 壓縮檔或體積檔（NRRD、NIfTI、MetaImage）拖放到此視窗任意處。</translation>
    </message>
    <message>
        <source>Open files...</source>
        <translation>開啟檔案…</translation>
    </message>
    <message>
        <source>Choose DICOM or volume files (Ctrl+O)</source>
        <translation>選擇 DICOM 或體積檔案 (Ctrl+O)</translation>
    </message>
    <message>
        <source>Open folder...</source>
        <translation>開啟資料夾…</translation>
    </message>
    <message>
        <source>Choose a folder; it is searched recursively (Ctrl+Shift+O)</source>
        <translation>選擇資料夾；會連同所有子資料夾一併搜尋 (Ctrl+Shift+O)</translation>
    </message>
    <message>
        <source>TRY A PHANTOM</source>
        <translation>試用假體</translation>
    </message>
    <message>
        <source>Head phantom</source>
        <translation>頭部假體</translation>
    </message>
    <message>
        <source>A built-in head: skull, brain, sinuses, teeth</source>
        <translation>內建頭部：顱骨、腦、鼻竇、牙齒</translation>
    </message>
    <message>
        <source>Chest phantom</source>
        <translation>胸部假體</translation>
    </message>
    <message>
        <source>A built-in chest: ribs, lungs, heart, spine</source>
        <translation>內建胸部：肋骨、肺、心臟、脊椎</translation>
    </message>
    <message>
        <source>RECENT</source>
        <translation>最近</translation>
    </message>
    <message>
        <source>Open %1</source>
        <translation>開啟%1</translation>
    </message>
    <message>
        <source>Recover the last session</source>
        <translation>復原上次的工作階段</translation>
    </message>
    <message>
        <source>Pellucid ended unexpectedly. Reopens the last study with its last look</source>
        <translation>Pellucid 意外結束。重新開啟上次的檢查，並恢復最後的外觀</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::StudyBeside</name>
    <message>
        <source>Linked</source>
        <translation>已連結</translation>
    </message>
    <message>
        <source>View, planes and window of both studies move together; unlink, match the planes by hand, and link again (Shift+Y)</source>
        <translation>兩個檢查的檢視、切面與窗會一起移動；可取消連結、手動對齊切面後再連結 (Shift+Y)</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>關閉</translation>
    </message>
    <message>
        <source>Close the second study</source>
        <translation>關閉並排的檢查</translation>
    </message>
    <message>
        <source>%1 (%2 y)</source>
        <translation>%1（%2 歲）</translation>
    </message>
    <message>
        <source>ID %1</source>
        <translation>病歷號 %1</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::StudyDocks</name>
    <message>
        <source>STUDIES</source>
        <translation>檢查</translation>
    </message>
    <message>
        <source>MEASUREMENTS</source>
        <translation>測量</translation>
    </message>
    <message>
        <source>Edit history</source>
        <translation>編輯歷程</translation>
    </message>
    <message>
        <source>Click an edit to return to the state after it</source>
        <translation>點按一項編輯，即回到該次編輯後的狀態</translation>
    </message>
    <message>
        <source>As opened</source>
        <translation>剛開啟時</translation>
    </message>
    <message>
        <source>HISTORY</source>
        <translation>歷程</translation>
    </message>
    <message>
        <source>TRANSFERS</source>
        <translation>傳輸</translation>
    </message>
    <message>
        <source>PRIOR STUDIES</source>
        <translation>先前檢查</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::StudyLibrary</name>
    <message>
        <source>Importing</source>
        <translation>正在匯入</translation>
    </message>
    <message>
        <source>Removing copies</source>
        <translation>正在移除複本</translation>
    </message>
    <message>
        <source>Tidying up the study library</source>
        <translation>正在整理檢查資料庫</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::StudyList</name>
    <message numerus="yes">
        <source>%1: %n images</source>
        <translation>
            <numerusform>%1：%n 張影像</numerusform>
        </translation>
    </message>
    <message>
        <source>%1: %2 of %3 here</source>
        <translation>%1：本機有 %2／%3</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::StudyOpener</name>
    <message>
        <source>Reading headers</source>
        <translation>正在讀取檔頭</translation>
    </message>
    <message>
        <source>Loading %1</source>
        <translation>正在載入%1</translation>
    </message>
    <message>
        <source>Preparing the projection</source>
        <translation>正在準備投影</translation>
    </message>
    <message>
        <source>images only</source>
        <translation>僅有影像</translation>
    </message>
    <message>
        <source>Arriving</source>
        <translation>接收中</translation>
    </message>
    <message>
        <source>Waiting for the first slices</source>
        <translation>等待最初的切片</translation>
    </message>
    <message>
        <source>%1 of %2 slices</source>
        <translation>%2 張切片中的 %1 張</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::StudyPanel</name>
    <message>
        <source>Import</source>
        <translation>匯入</translation>
    </message>
    <message>
        <source>Search studies</source>
        <translation>搜尋檢查</translation>
    </message>
    <message>
        <source>Words that a study must contain: name, identifier, date, modality, description (Ctrl+F)</source>
        <translation>檢查必須包含的字詞：姓名、識別碼、日期、儀器類別、說明 (Ctrl+F)</translation>
    </message>
    <message>
        <source>Sort</source>
        <translation>排序</translation>
    </message>
    <message>
        <source>Sort order of the studies</source>
        <translation>檢查的排序</translation>
    </message>
    <message>
        <source>Add studies to the library (Ctrl+I)</source>
        <translation>將檢查加入資料庫 (Ctrl+I)</translation>
    </message>
    <message>
        <source>Studies</source>
        <translation>檢查</translation>
    </message>
    <message>
        <source>Newest first</source>
        <translation>最新優先</translation>
    </message>
    <message>
        <source>By name</source>
        <translation>依姓名</translation>
    </message>
    <message>
        <source>Last added first</source>
        <translation>最近加入優先</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>開啟</translation>
    </message>
    <message>
        <source>Details...</source>
        <translation>詳細資料…</translation>
    </message>
    <message>
        <source>Remove from the library...</source>
        <translation>從資料庫移除…</translation>
    </message>
    <message>
        <source>Add to the library...</source>
        <translation>加入資料庫…</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>關閉</translation>
    </message>
    <message>
        <source>Remove the study %1 of %2 from the library?</source>
        <translation>要將 %2 的檢查「%1」從資料庫移除嗎？</translation>
    </message>
    <message numerus="yes">
        <source>%n files that were copied into the library are deleted.</source>
        <translation>
            <numerusform>將刪除 %n 個複製到資料庫的檔案。</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n files elsewhere stay where they are.</source>
        <translation>
            <numerusform>其他位置的 %n 個檔案保留不動。</numerusform>
        </translation>
    </message>
    <message>
        <source>Remove from the library</source>
        <translation>從資料庫移除</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>DICOM header...</source>
        <translation>DICOM 標頭…</translation>
    </message>
    <message>
        <source>Nothing found</source>
        <translation>找不到</translation>
    </message>
    <message>
        <source>No studies yet. Open one, or import studies into the library; files may also be dropped here.</source>
        <translation>尚無檢查。請開啟檢查，或將檢查匯入資料庫；亦可將檔案拖放至此。</translation>
    </message>
    <message>
        <source>No other study found</source>
        <translation>沒有其他符合的檢查</translation>
    </message>
    <message>
        <source>%1: searching</source>
        <translation>%1：搜尋中</translation>
    </message>
    <message>
        <source>Retrieve from %1</source>
        <translation>自 %1 取回</translation>
    </message>
    <message>
        <source>Send to</source>
        <translation>傳送至</translation>
    </message>
    <message>
        <source>Log in to %1</source>
        <translation>登入 %1</translation>
    </message>
    <message>
        <source>Open side by side</source>
        <translation>並排開啟</translation>
    </message>
    <message>
        <source>%1: more results than shown</source>
        <translation>%1：結果多於所顯示者</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::SubtractionDialog</name>
    <message>
        <source>&amp;Align it first (rotation and shift)</source>
        <translation>先對齊（旋轉與位移）(&amp;A)</translation>
    </message>
    <message>
        <source>Subtract a volume</source>
        <translation>減去體積</translation>
    </message>
    <message>
        <source>Subtract from %1, for example the pre-contrast phase:</source>
        <translation>從 %1 減去，例如注射顯影劑之前的時相：</translation>
    </message>
    <message>
        <source>Volumes of the patient</source>
        <translation>病患的體積</translation>
    </message>
    <message>
        <source>By mutual information; takes several seconds</source>
        <translation>以互資訊對齊，需時數秒</translation>
    </message>
    <message>
        <source>Subtract</source>
        <translation>減去</translation>
    </message>
    <message>
        <source>No other volume of this patient is open or in the library.</source>
        <translation>此病患沒有其他開啟的體積，資料庫中也沒有。</translation>
    </message>
    <message>
        <source>Nothing</source>
        <translation>無</translation>
    </message>
    <message>
        <source>The open volume</source>
        <translation>開啟的體積</translation>
    </message>
    <message>
        <source>Beside the difference</source>
        <translation>差異旁</translation>
    </message>
    <message>
        <source>The aligned volume, to check the alignment</source>
        <translation>已對齊的體積，以檢查對齊</translation>
    </message>
    <message>
        <source>Opens it at the right; both sides move together</source>
        <translation>於右側開啟；兩側一起移動</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::TextField</name>
    <message>
        <source>Text</source>
        <translation>文字</translation>
    </message>
    <message>
        <source>Text of the annotation</source>
        <translation>註記的文字</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::TransferFunctionPanel</name>
    <message>
        <source>Number of control points</source>
        <translation>控制點個數</translation>
    </message>
    <message>
        <source>Number of control points; more give a finer curve</source>
        <translation>控制點個數；越多曲線越精細</translation>
    </message>
    <message>
        <source> points</source>
        <translation> 點</translation>
    </message>
    <message>
        <source>Weight of the selected point</source>
        <translation>所選點的權重</translation>
    </message>
    <message>
        <source>Weight of the selected point, 0 to 2</source>
        <translation>所選點的權重，0 至 2</translation>
    </message>
    <message>
        <source>Reset</source>
        <translation>重設</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>複製</translation>
    </message>
    <message>
        <source>Copy the weights as text</source>
        <translation>將權重複製為文字</translation>
    </message>
    <message>
        <source>Paste</source>
        <translation>貼上</translation>
    </message>
    <message>
        <source>Paste 2 to 16 weights from 0 to 2</source>
        <translation>貼上 2 至 16 個介於 0 與 2 的權重</translation>
    </message>
    <message>
        <source>Control points</source>
        <translation>控制點</translation>
    </message>
    <message>
        <source>Reset curve</source>
        <translation>重設曲線</translation>
    </message>
    <message>
        <source>Transfer function</source>
        <translation>轉換函數</translation>
    </message>
    <message>
        <source>The clipboard contains no weights</source>
        <translation>剪貼簿中沒有權重</translation>
    </message>
    <message>
        <source>Paste curve</source>
        <translation>貼上曲線</translation>
    </message>
    <message>
        <source>Whole volume</source>
        <translation>整個體積</translation>
    </message>
    <message>
        <source>The value at the left end of the curve; lower values have its weight</source>
        <translation>曲線左端的數值；更低的數值採用其權重</translation>
    </message>
    <message>
        <source>Lowest value of the curve</source>
        <translation>曲線的最低值</translation>
    </message>
    <message>
        <source>The value at the right end of the curve; higher values have its weight</source>
        <translation>曲線右端的數值；更高的數值採用其權重</translation>
    </message>
    <message>
        <source>Highest value of the curve</source>
        <translation>曲線的最高值</translation>
    </message>
    <message>
        <source>Range of the curve</source>
        <translation>曲線的範圍</translation>
    </message>
    <message>
        <source>Set all weights to 1 and cover all values</source>
        <translation>將所有權重設為 1，並涵蓋所有數值</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::TransferQueue</name>
    <message>
        <source>Retrieving %1</source>
        <translation>正在取回 %1</translation>
    </message>
</context>
<context>
    <name>pellucid::ui::TransfersPanel</name>
    <message>
        <source>Nothing has been retrieved yet. Search for a study, and double-click one that a server has.</source>
        <translation>尚未取回任何檢查。請搜尋檢查，並按兩下伺服器所有的檢查。</translation>
    </message>
    <message>
        <source>Clear</source>
        <translation>清除</translation>
    </message>
    <message>
        <source>Transfers</source>
        <translation>傳輸</translation>
    </message>
    <message>
        <source>Remove finished transfers from the list; the images stay</source>
        <translation>從清單中移除已結束者；影像仍保留</translation>
    </message>
    <message>
        <source>waiting</source>
        <translation>等待中</translation>
    </message>
    <message>
        <source>listing</source>
        <translation>列出中</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1／%2</translation>
    </message>
    <message numerus="yes">
        <source>%n images</source>
        <translation>
            <numerusform>%n 張影像</numerusform>
        </translation>
    </message>
    <message>
        <source>cancelled</source>
        <translation>已取消</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>再試一次</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>Drop studies or files here to send:</source>
        <translation>將檢查或檔案拖曳至此以傳送：</translation>
    </message>
    <message>
        <source>Nothing is received: %1</source>
        <translation>未接收任何內容：%1</translation>
    </message>
    <message numerus="yes">
        <source>%1 receives on port %2; %n objects have arrived</source>
        <translation>
            <numerusform>%1 於連接埠 %2 接收；已收到 %n 個物件</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>pellucid::ui::WindowChooser</name>
    <message>
        <source>Width and center...</source>
        <translation>窗寬與窗位…</translation>
    </message>
</context>
</TS>
