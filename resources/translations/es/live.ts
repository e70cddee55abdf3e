<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es">
<context>
    <name>CountsView</name>
    <message>
        <source>All fruit</source>
        <translation>Toda la fruta</translation>
    </message>
    <message>
        <source>{litres} · {rate}/min</source>
        <translation>{litres} · {rate}/min</translation>
    </message>
    <message>
        <source>{rate}/min</source>
        <translation>{rate}/min</translation>
    </message>
</context>
<context>
    <name>LastFruitView</name>
    <message>
        <source>Each fruit appears here as it is counted.</source>
        <translation>Cada fruta aparece aquí al contarse.</translation>
    </message>
</context>
</TS>
