<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es">
<context>
    <name>BeltView</name>
    <message>
        <source>The belt from above appears here while a lot runs.</source>
        <translation>Aquí aparece la cinta vista desde arriba mientras corre un lote.</translation>
    </message>
</context>
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
        <source>mean {volume}</source>
        <translation>media {volume}</translation>
    </message>
    <message>
        <source>{rate}/min</source>
        <translation>{rate}/min</translation>
    </message>
    <message>
        <source>spread {spread}</source>
        <translation>dispersión {spread}</translation>
    </message>
</context>
<context>
    <name>EndDialog</name>
    <message>
        <source>End lot</source>
        <translation>Terminar lote</translation>
    </message>
    <message>
        <source>Leave it open</source>
        <translation>Dejarlo abierto</translation>
    </message>
    <message>
        <source>End lot {name}?</source>
        <translation>¿Terminar el lote {name}?</translation>
    </message>
    <message>
        <source>Fruit counted so far: {count}</source>
        <translation>Fruta contada hasta ahora: {count}</translation>
    </message>
    <message>
        <source>What is in view is counted first, then the line stops.</source>
        <translation>Antes se cuenta lo que está a la vista; luego la línea se detiene.</translation>
    </message>
    <message>
        <source>A lot that is ended cannot be taken up again.</source>
        <translation>Un lote terminado no se puede retomar.</translation>
    </message>
    <message>
        <source>To go on with it later, pause it.</source>
        <translation>Para seguir más tarde, páuselo.</translation>
    </message>
    <message>
        <source>Left open, you can go on with it at any time.</source>
        <translation>Si lo deja abierto, puede seguir con él cuando quiera.</translation>
    </message>
</context>
<context>
    <name>Health</name>
    <message>
        <source>the last picture of the recording</source>
        <translation>la última imagen de la grabación</translation>
    </message>
    <message>
        <source>no picture yet</source>
        <translation>todavía sin imagen</translation>
    </message>
    <message>
        <source>no picture for {time}</source>
        <translation>sin imagen desde hace {time}</translation>
    </message>
    <message>
        <source>does not answer</source>
        <translation>no responde</translation>
    </message>
    <message>
        <source>may be blinded</source>
        <translation>puede estar deslumbrado</translation>
    </message>
    <message>
        <source>loses pictures</source>
        <translation>pierde imágenes</translation>
    </message>
    <message>
        <source>starting</source>
        <translation>arrancando</translation>
    </message>
    <message>
        <source>silent</source>
        <translation>sin señal</translation>
    </message>
    <message>
        <source>failed, is opened again</source>
        <translation>falló, se abre de nuevo</translation>
    </message>
    <message>
        <source>recording is over</source>
        <translation>terminó la grabación</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>detenido</translation>
    </message>
</context>
<context>
    <name>LastFruitView</name>
    <message>
        <source>Each fruit appears here as it is counted.</source>
        <translation>Cada fruta aparece aquí al contarse.</translation>
    </message>
</context>
<context>
    <name>LiveLayout</name>
    <message>
        <source>What is drawn over the pictures (F5 to F8)</source>
        <translation>Qué se dibuja sobre las imágenes (F5 a F8)</translation>
    </message>
    <message>
        <source>How volumes are spread is shown at step 7: here the counts take the room.</source>
        <translation>Cómo se reparten los volúmenes se ve en el paso 7: aquí los conteos ocupan el lugar.</translation>
    </message>
</context>
<context>
    <name>LivePage</name>
    <message>
        <source>Start lot</source>
        <translation>Iniciar lote</translation>
    </message>
    <message>
        <source>Go on with the lot</source>
        <translation>Seguir con el lote</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pausar</translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>Seguir</translation>
    </message>
    <message>
        <source>End lot</source>
        <translation>Terminar lote</translation>
    </message>
    <message>
        <source>Stop the line, count what is in view, end the lot</source>
        <translation>Detener la línea, contar lo que está a la vista y terminar el lote</translation>
    </message>
    <message>
        <source>Give the fruit that were set aside as unknown their kinds; the line goes on</source>
        <translation>Dé su tipo a las frutas apartadas como desconocidas; la línea sigue</translation>
    </message>
    <message>
        <source>Outlines</source>
        <translation>Contornos</translation>
    </message>
    <message>
        <source>Labels</source>
        <translation>Etiquetas</translation>
    </message>
    <message>
        <source>± of places</source>
        <translation>± de las posiciones</translation>
    </message>
    <message>
        <source>Trails</source>
        <translation>Trayectorias</translation>
    </message>
    <message>
        <source>The sensors are being started.</source>
        <translation>Se están iniciando los sensores.</translation>
    </message>
    <message>
        <source>No sensor runs: start them again.</source>
        <translation>Ningún sensor funciona: inícielos de nuevo.</translation>
    </message>
    <message>
        <source>Start a lot to count fruit.</source>
        <translation>Inicie un lote para contar fruta.</translation>
    </message>
    <message>
        <source>Lot {name} is still open; every fruit that was counted is kept.</source>
        <translation>El lote {name} sigue abierto; toda la fruta contada está guardada.</translation>
    </message>
    <message>
        <source>Lot {name} is paused: fruit pass uncounted.</source>
        <translation>El lote {name} está en pausa: la fruta pasa sin contarse.</translation>
    </message>
    <message>
        <source>Nothing can be counted yet</source>
        <translation>Todavía no se puede contar</translation>
    </message>
    <message>
        <source>Lot {name} is running.</source>
        <translation>El lote {name} está en marcha.</translation>
    </message>
    <message>
        <source>Lot {name} is paused.</source>
        <translation>El lote {name} está en pausa.</translation>
    </message>
    <message>
        <source>Lot {name} is open; the line stands still.</source>
        <translation>El lote {name} está abierto; la línea está detenida.</translation>
    </message>
    <message>
        <source>Nothing is counted</source>
        <translation>No se cuenta nada</translation>
    </message>
    <message>
        <source>Name unknown fruit: {count}</source>
        <translation>Nombrar desconocidas: {count}</translation>
    </message>
</context>
<context>
    <name>LotDialog</name>
    <message>
        <source>Start</source>
        <translation>Iniciar</translation>
    </message>
    <message>
        <source>New lot</source>
        <translation>Lote nuevo</translation>
    </message>
    <message>
        <source>&amp;Lot</source>
        <translation>&amp;Lote</translation>
    </message>
    <message>
        <source>&amp;Grower</source>
        <translation>&amp;Productor</translation>
    </message>
    <message>
        <source>&amp;Recipe</source>
        <translation>&amp;Receta</translation>
    </message>
    <message>
        <source>&amp;Note</source>
        <translation>&amp;Nota</translation>
    </message>
</context>
</TS>
