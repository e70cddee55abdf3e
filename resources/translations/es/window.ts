<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es">
<context>
    <name>ActionBar</name>
    <message>
        <source>Close</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop this job; nothing is left half-done (Esc)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stopping …</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Steps</name>
    <message>
        <source>Connect</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Calibrate</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Belt</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Teach</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Train</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Live</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lots</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>to do</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ready</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>done</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>do again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>First finish the step “{step}”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not there now: {sensors}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>added: {sensors}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>removed: {sensors}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>exchanged: {sensors}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The sensors are not those that were calibrated ({changes}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Another sensor is the reference now: {sensor}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>More is to be taught (samples, pieces of fruit): {kinds}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Teach at least two kinds.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The kinds taught are not those of the model ({kinds}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A sensor was moved; calibrate again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The sensors were calibrated again since.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Trained with an earlier calibration.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>More was taught since it was trained.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Without a model every fruit counts as unknown.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The line is running.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>TopBar</name>
    <message>
        <source>Light or dark (Ctrl+T)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Settings (Ctrl+,)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Help (F1)</source>
        <translation type="unfinished"></translation>
    </message>
</context>
</TS>
