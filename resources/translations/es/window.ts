<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es">
<context>
    <name>ActionBar</name>
    <message>
        <source>Close</source>
        <translation>Cerrar</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Detener</translation>
    </message>
    <message>
        <source>Stop this job; nothing is left half-done (Esc)</source>
        <translation>Detener este trabajo; nada queda a medias (Esc)</translation>
    </message>
    <message>
        <source>Put this message away</source>
        <translation>Quitar este mensaje</translation>
    </message>
    <message>
        <source>Information</source>
        <translation>Información</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>Hecho</translation>
    </message>
    <message>
        <source>Warning</source>
        <translation>Advertencia</translation>
    </message>
    <message>
        <source>Error</source>
        <translation>Error</translation>
    </message>
    <message>
        <source>Stopping …</source>
        <translation>Deteniendo …</translation>
    </message>
</context>
<context>
    <name>Application</name>
    <message>
        <source>the window</source>
        <translation>la ventana</translation>
    </message>
    <message>
        <source>{file} cannot be used; it lies where it was.</source>
        <translation>{file} no se puede usar; quedó donde estaba.</translation>
    </message>
    <message>
        <source>{file} is damaged; it was set aside, unharmed.</source>
        <translation>{file} está dañado; se apartó sin tocarlo.</translation>
    </message>
    <message>
        <source>Take the last good one</source>
        <translation>Usar el último bueno</translation>
    </message>
</context>
<context>
    <name>Blind</name>
    <message>
        <source>{sensors} away: every part of the belt is still seen by another sensor</source>
        <translation>Falta {sensors}: otro sensor sigue viendo cada parte de la cinta</translation>
    </message>
    <message>
        <source>{sensors} away: {share} of the belt is seen by no sensor</source>
        <translation>Falta {sensors}: ningún sensor ve el {share} de la cinta</translation>
    </message>
    <message>
        <source>{sensors} away: no sensor sees {lanes}</source>
        <translation>Falta {sensors}: ningún sensor ve {lanes}</translation>
    </message>
    <message>
        <source>{sensors}: too few pictures at this speed; another sensor sees every part of the belt</source>
        <translation>{sensors}: pocas imágenes para esta velocidad; otro sensor ve cada parte de la cinta</translation>
    </message>
    <message>
        <source>{sensors}: too few pictures at this speed; no other sensor sees {share} of the belt</source>
        <translation>{sensors}: pocas imágenes para esta velocidad; ningún otro sensor ve el {share} de la cinta</translation>
    </message>
    <message>
        <source>{sensors}: too few pictures at this speed; no other sensor sees {lanes}</source>
        <translation>{sensors}: pocas imágenes para esta velocidad; ningún otro sensor ve {lanes}</translation>
    </message>
    <message>
        <source>any of the belt</source>
        <translation>nada de la cinta</translation>
    </message>
    <message>
        <source>the left part of the belt ({lane} from its right edge)</source>
        <translation>la parte izquierda de la cinta ({lane} desde su borde derecho)</translation>
    </message>
    <message>
        <source>a middle part of the belt ({lane} from its right edge)</source>
        <translation>una parte central de la cinta ({lane} desde su borde derecho)</translation>
    </message>
    <message>
        <source>the right part of the belt ({lane} from its edge)</source>
        <translation>la parte derecha de la cinta ({lane} desde su borde)</translation>
    </message>
    <message>
        <source>Fruit there are not counted. Check cable and power; it starts again by itself.</source>
        <translation>Las frutas que pasan allí no se cuentan. Revise cable y corriente; vuelve a arrancar solo.</translation>
    </message>
    <message>
        <source>Sizes are less sure meanwhile. Check cable and power; it starts again by itself.</source>
        <translation>Mientras tanto los tamaños son menos seguros. Revise cable y corriente; vuelve a arrancar solo.</translation>
    </message>
    <message>
        <source>Fruit there may be missed. Slow the belt down; step 1 says why pictures are lost.</source>
        <translation>Ahí puede perderse fruta. Baje la velocidad de la cinta; el paso 1 dice por qué se pierden imágenes.</translation>
    </message>
    <message>
        <source>Sizes are less sure meanwhile. Slow the belt down; step 1 says why pictures are lost.</source>
        <translation>Mientras tanto los tamaños son menos seguros. Baje la velocidad de la cinta; el paso 1 dice por qué se pierden imágenes.</translation>
    </message>
</context>
<context>
    <name>Health</name>
    <message>
        <source>A sensor was moved since it was calibrated: {sensors}.</source>
        <translation>Se movió un sensor desde que se calibró: {sensors}.</translation>
    </message>
    <message>
        <source>End the lot and calibrate again; sizes and counts since may be wrong.</source>
        <translation>Termine el lote y calibre de nuevo; los tamaños y conteos desde entonces pueden estar mal.</translation>
    </message>
    <message>
        <source>Fruit cannot be kept on the disk now; they wait in memory.</source>
        <translation>Ahora no se puede guardar fruta en el disco; espera en memoria.</translation>
    </message>
    <message>
        <source>Make room on the disk. Counting goes on, and what waits is kept then.</source>
        <translation>Haga espacio en el disco. El conteo sigue, y lo que espera se guarda entonces.</translation>
    </message>
    <message>
        <source>The clock of {sensors} was off and was put right, judged by the fruit.</source>
        <translation>El reloj de {sensors} estaba desfasado y se corrigió según la fruta.</translation>
    </message>
    <message>
        <source>Sensors and calibration differ; the line runs on what both have.</source>
        <translation>Los sensores y la calibración no coinciden; la línea sigue con lo que ambos tienen.</translation>
    </message>
    <message>
        <source>The log says what went wrong: open the help, then Show log.</source>
        <translation>El registro dice qué falló: abra la ayuda y luego Ver registro.</translation>
    </message>
    <message>
        <source>Connect the sensors that were calibrated, or calibrate again.</source>
        <translation>Conecte los sensores que se calibraron, o calibre de nuevo.</translation>
    </message>
    <message>
        <source>The clock of {sensors} leapt: fruit of this moment may be missing or twice.</source>
        <translation>El reloj de {sensors} saltó: puede faltar fruta de este momento o estar dos veces.</translation>
    </message>
    <message>
        <source>It is followed on from there. If this comes back, unplug the sensor and plug it in again.</source>
        <translation>Se sigue desde ahí. Si se repite, desenchufe el sensor y enchúfelo de nuevo.</translation>
    </message>
    <message>
        <source>No fruit was counted before; nothing is to be done.</source>
        <translation>Antes no se contó ninguna fruta; no hay nada que hacer.</translation>
    </message>
    <message>
        <source>A picture of {sensors} could not be used and was left out.</source>
        <translation>Una imagen de {sensors} no se pudo usar y se omitió.</translation>
    </message>
    <message>
        <source>If this comes back, look at the sensor&apos;s cable; the log says more.</source>
        <translation>Si se repite, revise el cable del sensor; el registro dice más.</translation>
    </message>
    <message>
        <source>A fruit could not be measured; it is counted with a rough volume.</source>
        <translation>Una fruta no se pudo medir; se cuenta con un volumen aproximado.</translation>
    </message>
    <message>
        <source>Look at it in the lot, and correct it there if need be.</source>
        <translation>Revísela en el lote y corríjala ahí si hace falta.</translation>
    </message>
    <message>
        <source>No pictures came from {sensors} for a while.</source>
        <translation>Durante un rato no llegaron imágenes de {sensors}.</translation>
    </message>
    <message>
        <source>Fruit that only it sees were not counted. Check cable and power.</source>
        <translation>Las frutas que solo él ve no se contaron. Revise cable y corriente.</translation>
    </message>
    <message>
        <source>Too few pictures came from {sensors} for a while.</source>
        <translation>Durante un rato llegaron pocas imágenes de {sensors}.</translation>
    </message>
    <message>
        <source>Fruit that only it sees may be missing. Step 1 says why pictures are lost.</source>
        <translation>Puede faltar fruta que solo ve ese sensor. El paso 1 dice por qué se pierden imágenes.</translation>
    </message>
    <message>
        <source>A driver hangs, and a projector may be on out of its turn: {sensors}.</source>
        <translation>Un controlador no responde, y un proyector puede estar encendido fuera de su turno: {sensors}.</translation>
    </message>
    <message>
        <source>Depth may have holes and sizes may be wrong. Unplug the sensor that gives no pictures.</source>
        <translation>La profundidad puede tener huecos y los tamaños pueden ser erróneos. Desenchufe el sensor que no da imágenes.</translation>
    </message>
    <message>
        <source>What {sensors} sees could not be drawn; fruit are counted all the same.</source>
        <translation>No se pudo dibujar lo que ve {sensors}; la fruta se cuenta igualmente.</translation>
    </message>
    <message>
        <source>Whether every sensor gives pictures is not known; the line goes on.</source>
        <translation>No se sabe si todos los sensores dan imágenes; la línea sigue.</translation>
    </message>
    <message>
        <source>Look at the pictures; the log says what went wrong.</source>
        <translation>Mire las imágenes; el registro dice qué falló.</translation>
    </message>
    <message>
        <source>A fruit was followed but could not be counted.</source>
        <translation>Una fruta se siguió pero no se pudo contar.</translation>
    </message>
    <message>
        <source>The line broke off and goes on; fruit that were in view may be missing.</source>
        <translation>La línea se interrumpió y sigue; puede faltar la fruta que estaba a la vista.</translation>
    </message>
    <message>
        <source>Nothing is to be done now. If this comes back, call for help.</source>
        <translation>Ahora no hay nada que hacer. Si se repite, pida ayuda.</translation>
    </message>
    <message>
        <source>The line broke off again and again: nothing is counted now.</source>
        <translation>La línea se interrumpió una y otra vez: ahora no se cuenta nada.</translation>
    </message>
    <message>
        <source>End the lot and start a new one. If this comes back, call for help.</source>
        <translation>Termine el lote e inicie otro. Si se repite, pida ayuda.</translation>
    </message>
    <message>
        <source>Most fruit are unknown to the model: the light or the belt&apos;s colour may have changed since teaching.</source>
        <translation>El modelo no conoce la mayor parte de la fruta: la luz o el color de la cinta pueden ser otros que al enseñar.</translation>
    </message>
    <message>
        <source>Clean the belt where it is wet or dirty; or name some of these fruit and train again.</source>
        <translation>Limpie la cinta si está mojada o sucia; o nombre algunas de estas frutas y entrene de nuevo.</translation>
    </message>
    <message>
        <source>{well}/{all} sensors</source>
        <translation>{well}/{all} sensores</translation>
    </message>
    <message>
        <source>All sensors give pictures.</source>
        <translation>Todos los sensores dan imágenes.</translation>
    </message>
    <message>
        <source>The sensors are starting.</source>
        <translation>Los sensores están arrancando.</translation>
    </message>
    <message>
        <source>No pictures from {sensors}; its part of the belt is not seen.</source>
        <translation>Sin imágenes de {sensors}; su parte de la cinta no se ve.</translation>
    </message>
    <message>
        <source>From a picture to what is drawn: {latency}. Waiting: {backlog} pictures. Left out: {dropped}.</source>
        <translation>De la imagen a lo dibujado: {latency}. En espera: {backlog} imágenes. Omitidas: {dropped}.</translation>
    </message>
    <message>
        <source>Recording {name}: see Connect.</source>
        <translation>Grabando {name}: véase Conectar.</translation>
    </message>
    <message>
        <source>Free on the disk: {free} GB. Recording and keeping pictures stop below {least} GB.</source>
        <translation>Libre en el disco: {free} GB. Por debajo de {least} GB se deja de grabar y de guardar fotos.</translation>
    </message>
</context>
<context>
    <name>HelpWindow</name>
    <message>
        <source>Help</source>
        <translation>Ayuda</translation>
    </message>
    <message>
        <source>Show log</source>
        <translation>Ver registro</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Cerrar</translation>
    </message>
    <message>
        <source>Open the file in which everything that went wrong is written down</source>
        <translation>Abrir el archivo donde se anota todo lo que falló</translation>
    </message>
</context>
<context>
    <name>HistogramView</name>
    <message>
        <source>The volumes of what was counted appear here.</source>
        <translation>Aquí aparecen los volúmenes de lo contado.</translation>
    </message>
</context>
<context>
    <name>Housekeeping</name>
    <message>
        <source>Letting old pictures go</source>
        <translation>Retirando imágenes viejas</translation>
    </message>
</context>
<context>
    <name>KeepingTime</name>
    <message>
        <source>A week</source>
        <translation>Una semana</translation>
    </message>
    <message>
        <source>A month</source>
        <translation>Un mes</translation>
    </message>
    <message>
        <source>A season: three months</source>
        <translation>Una temporada: tres meses</translation>
    </message>
    <message>
        <source>A year</source>
        <translation>Un año</translation>
    </message>
    <message>
        <source>For ever</source>
        <translation>Para siempre</translation>
    </message>
    <message>
        <source>Another number of days</source>
        <translation>Otro número de días</translation>
    </message>
    <message>
        <source> days</source>
        <translation> días</translation>
    </message>
    <message>
        <source>Number of days</source>
        <translation>Número de días</translation>
    </message>
</context>
<context>
    <name>Kinds</name>
    <message>
        <source>Unknown</source>
        <translation>Desconocida</translation>
    </message>
</context>
<context>
    <name>LossDialog</name>
    <message>
        <source>Close and lose them</source>
        <translation>Cerrar y perderlas</translation>
    </message>
    <message>
        <source>Leave it open</source>
        <translation>Dejarla abierta</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Cerrar</translation>
    </message>
    <message>
        <source>Close, though the disk is full?</source>
        <translation>¿Cerrar, aunque el disco esté lleno?</translation>
    </message>
    <message>
        <source>Fruit that wait for the disk: {count}</source>
        <translation>Frutas que esperan al disco: {count}</translation>
    </message>
    <message>
        <source>They were not shown as counted, and are lost when the window closes. Make room on the disk: a few seconds later they are kept.</source>
        <translation>No se mostraron como contadas, y se pierden al cerrar la ventana. Libere espacio en el disco: a los pocos segundos quedan guardadas.</translation>
    </message>
</context>
<context>
    <name>ManualView</name>
    <message>
        <source>Manual</source>
        <translation>Manual</translation>
    </message>
</context>
<context>
    <name>ModelCheck</name>
    <message>
        <source>{file} cannot be read.</source>
        <translation>{file} no se puede leer.</translation>
    </message>
    <message>
        <source>{file} is damaged; it was set aside, unharmed.</source>
        <translation>{file} está dañado; se apartó sin tocarlo.</translation>
    </message>
    <message>
        <source>No lot starts without the model that it is to name fruit by.</source>
        <translation>Ningún lote empieza sin el modelo con que debe nombrar la fruta.</translation>
    </message>
    <message>
        <source>Take the last good one</source>
        <translation>Usar el último bueno</translation>
    </message>
    <message>
        <source>Count without a model</source>
        <translation>Contar sin modelo</translation>
    </message>
    <message>
        <source>Fruit count as unknown, until a model is trained and accepted.</source>
        <translation>La fruta cuenta como desconocida hasta que se entrene y acepte un modelo.</translation>
    </message>
    <message>
        <source>The last good model is in use.</source>
        <translation>El último modelo bueno está en uso.</translation>
    </message>
</context>
<context>
    <name>Recorder</name>
    <message>
        <source>Recording</source>
        <translation>Grabación</translation>
    </message>
    <message>
        <source>Show the folder</source>
        <translation>Mostrar la carpeta</translation>
    </message>
    <message>
        <source>Nothing was recorded: the sensors had given nothing yet.</source>
        <translation>No se grabó nada: los sensores aún no habían dado nada.</translation>
    </message>
    <message>
        <source>{name} is recorded: {lasted}, {size}.</source>
        <translation>{name} está grabada: {lasted}, {size}.</translation>
    </message>
    <message>
        <source>It was ended because the disk is nearly full.</source>
        <translation>Se terminó porque el disco está casi lleno.</translation>
    </message>
    <message>
        <source>It was ended because no sensor gives pictures any more.</source>
        <translation>Se terminó porque ningún sensor da ya imágenes.</translation>
    </message>
    <message>
        <source>{count} pictures did not come whole from the sensors: check them.</source>
        <translation>{count} imágenes no llegaron enteras de los sensores: revíselos.</translation>
    </message>
    <message>
        <source>{count} pictures were lost: this computer, or its disk, is too slow.</source>
        <translation>Se perdieron {count} imágenes: este computador, o su disco, es demasiado lento.</translation>
    </message>
    <message>
        <source>Without pictures for a while: {sensors}.</source>
        <translation>Sin imágenes durante un rato: {sensors}.</translation>
    </message>
    <message>
        <source>{frames} pictures, {size}</source>
        <translation>{frames} imágenes, {size}</translation>
    </message>
    <message>
        <source>{size} free</source>
        <translation>{size} libres</translation>
    </message>
    <message>
        <source>{size} free, enough for {time}</source>
        <translation>{size} libres, para {time}</translation>
    </message>
</context>
<context>
    <name>Running</name>
    <message>
        <source>Counting the fruit still in view</source>
        <translation>Contando la fruta que aún está a la vista</translation>
    </message>
    <message>
        <source>Ending the lot</source>
        <translation>Terminando el lote</translation>
    </message>
    <message>
        <source>Starting the line</source>
        <translation>Poniendo en marcha la línea</translation>
    </message>
    <message>
        <source>Starting the lot</source>
        <translation>Iniciando el lote</translation>
    </message>
    <message>
        <source>Lot {name} is ended with {count} fruit.</source>
        <translation>El lote {name} terminó con {count} frutas.</translation>
    </message>
    <message>
        <source>Keeping the lot</source>
        <translation>Guardando el lote</translation>
    </message>
    <message>
        <source>Stopping the line</source>
        <translation>Deteniendo la línea</translation>
    </message>
    <message>
        <source>The sensors were changed, so the line was stopped.</source>
        <translation>Se cambiaron los sensores, por eso se detuvo la línea.</translation>
    </message>
    <message>
        <source>The lot is still open: go on with it on the live screen.</source>
        <translation>El lote sigue abierto: continúelo en la pantalla En vivo.</translation>
    </message>
    <message>
        <source>Unknown, {time}</source>
        <translation>Desconocidas, {time}</translation>
    </message>
</context>
<context>
    <name>SettingsDialog</name>
    <message>
        <source>Settings</source>
        <translation>Ajustes</translation>
    </message>
    <message>
        <source>As the system</source>
        <translation>Como el sistema</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Oscuro</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Claro</translation>
    </message>
    <message>
        <source>Normal</source>
        <translation>Normal</translation>
    </message>
    <message>
        <source>Large</source>
        <translation>Grande</translation>
    </message>
    <message>
        <source>Larger</source>
        <translation>Más grande</translation>
    </message>
    <message>
        <source>Very large</source>
        <translation>Muy grande</translation>
    </message>
    <message>
        <source>Size of &amp;words</source>
        <translation>&amp;Tamaño de las letras</translation>
    </message>
    <message>
        <source>Buttons and pictures grow with them, from the next start on.</source>
        <translation>Los botones y las imágenes crecen con ellas, desde el próximo inicio.</translation>
    </message>
    <message>
        <source>Once saved, older pictures are deleted for good. Counts, sizes and what was taught stay for ever.</source>
        <translation>Al guardar, las fotos más antiguas se borran para siempre. Cantidades, tamaños y lo enseñado quedan.</translation>
    </message>
    <message>
        <source>Older pictures of counted fruit go. Counts, sizes and what was taught stay for ever.</source>
        <translation>Las fotos más antiguas de la fruta contada se borran. Cantidades, tamaños y lo enseñado quedan.</translation>
    </message>
    <message>
        <source>&amp;Language</source>
        <translation>&amp;Idioma</translation>
    </message>
    <message>
        <source>L&amp;ook</source>
        <translation>&amp;Aspecto</translation>
    </message>
    <message>
        <source>Keep &amp;pictures of fruit</source>
        <translation>Guardar &amp;fotos de la fruta</translation>
    </message>
    <message>
        <source>&amp;Free room that stays on the disk</source>
        <translation>&amp;Espacio que queda libre en el disco</translation>
    </message>
    <message>
        <source>With less, recording stops and no more pictures are kept. Counting goes on.</source>
        <translation>Con menos, se deja de grabar y de guardar fotos. El conteo sigue.</translation>
    </message>
</context>
<context>
    <name>ShowSwitch</name>
    <message>
        <source>Simulated belt</source>
        <translation>Cinta simulada</translation>
    </message>
    <message>
        <source>Runs</source>
        <translation>Avanza</translation>
    </message>
    <message>
        <source>Let the simulated belt run with fruit on it</source>
        <translation>Hacer avanzar la cinta simulada con fruta encima</translation>
    </message>
    <message>
        <source>Rests</source>
        <translation>Quieta</translation>
    </message>
    <message>
        <source>Stop the simulated belt, and lay fruit on it</source>
        <translation>Detener la cinta simulada y ponerle fruta</translation>
    </message>
    <message>
        <source>Empty</source>
        <translation>Vacía</translation>
    </message>
    <message>
        <source>Stop the simulated belt, and clear it</source>
        <translation>Detener la cinta simulada y despejarla</translation>
    </message>
</context>
<context>
    <name>SourceRunner</name>
    <message>
        <source>Stopping the sensors that ran before</source>
        <translation>Deteniendo los sensores que funcionaban antes</translation>
    </message>
    <message>
        <source>Opening the source</source>
        <translation>Abriendo la fuente</translation>
    </message>
    <message>
        <source>Connecting the sensors</source>
        <translation>Conectando los sensores</translation>
    </message>
</context>
<context>
    <name>SpeedWatch</name>
    <message>
        <source>The belt runs at {speed}; these sensors follow fruit up to {highest}.</source>
        <translation>La cinta va a {speed}; estos sensores siguen la fruta hasta {highest}.</translation>
    </message>
    <message>
        <source>Slow it down: fruit may be missed, or counted twice. Step 1 says what limits the speed.</source>
        <translation>Redúzcala: puede faltar fruta, o contarse dos veces. El paso 1 dice qué limita la velocidad.</translation>
    </message>
</context>
<context>
    <name>Steadiness</name>
    <message>
        <source>The depth of {sensor} still drifts: it warms up.</source>
        <translation>La profundidad de {sensor} todavía varía: se está calentando.</translation>
    </message>
    <message>
        <source>Sizes are right once it is steady; the screen “Connect” says when.</source>
        <translation>Los tamaños serán correctos cuando se estabilice; la pantalla «Conectar» dice cuándo.</translation>
    </message>
    <message>
        <source>The colour of the light that {sensor} sees on the belt has changed.</source>
        <translation>El color de la luz que {sensor} ve en la cinta ha cambiado.</translation>
    </message>
    <message>
        <source>The belt is much brighter for {sensor} than at first.</source>
        <translation>{sensor} ve la cinta mucho más clara que al principio.</translation>
    </message>
    <message>
        <source>The belt is much darker for {sensor} than at first.</source>
        <translation>{sensor} ve la cinta mucho más oscura que al principio.</translation>
    </message>
    <message>
        <source>Kinds may be mistaken. Bring the light back, or start the sensors again so that they adjust to it.</source>
        <translation>Los tipos pueden confundirse. Restablezca la luz o reinicie los sensores para que se ajusten a ella.</translation>
    </message>
</context>
<context>
    <name>Steps</name>
    <message>
        <source>Connect</source>
        <translation>Conectar</translation>
    </message>
    <message>
        <source>Calibrate</source>
        <translation>Calibrar</translation>
    </message>
    <message>
        <source>Belt</source>
        <translation>Cinta</translation>
    </message>
    <message>
        <source>Teach</source>
        <translation>Enseñar</translation>
    </message>
    <message>
        <source>Train</source>
        <translation>Entrenar</translation>
    </message>
    <message>
        <source>Live</source>
        <translation>En vivo</translation>
    </message>
    <message>
        <source>Lots</source>
        <translation>Lotes</translation>
    </message>
    <message>
        <source>Go to the sensors</source>
        <translation>Ir a los sensores</translation>
    </message>
    <message>
        <source>Go to calibrating</source>
        <translation>Ir a la calibración</translation>
    </message>
    <message>
        <source>Set the belt</source>
        <translation>Ajustar la cinta</translation>
    </message>
    <message>
        <source>Go to the belt</source>
        <translation>Ir a la cinta</translation>
    </message>
    <message>
        <source>Go to teaching</source>
        <translation>Ir a enseñar</translation>
    </message>
    <message>
        <source>Go to training</source>
        <translation>Ir al entrenamiento</translation>
    </message>
    <message>
        <source>Go live</source>
        <translation>Ir en vivo</translation>
    </message>
    <message>
        <source>Go to the live screen</source>
        <translation>Ir a la pantalla en vivo</translation>
    </message>
    <message>
        <source>Go to what has been run</source>
        <translation>Ir a lo que se ha procesado</translation>
    </message>
    <message>
        <source>to do</source>
        <translation>pendiente</translation>
    </message>
    <message>
        <source>ready</source>
        <translation>listo</translation>
    </message>
    <message>
        <source>done</source>
        <translation>hecho</translation>
    </message>
    <message>
        <source>do again</source>
        <translation>repetir</translation>
    </message>
    <message>
        <source>First finish the step “{step}”.</source>
        <translation>Primero termine el paso «{step}».</translation>
    </message>
    <message>
        <source>Not there now: {sensors}.</source>
        <translation>No están ahora: {sensors}.</translation>
    </message>
    <message>
        <source>added: {sensors}</source>
        <translation>agregados: {sensors}</translation>
    </message>
    <message>
        <source>removed: {sensors}</source>
        <translation>quitados: {sensors}</translation>
    </message>
    <message>
        <source>exchanged: {sensors}</source>
        <translation>cambiados: {sensors}</translation>
    </message>
    <message>
        <source>The sensors are not those that were calibrated ({changes}).</source>
        <translation>Los sensores no son los que se calibraron ({changes}).</translation>
    </message>
    <message>
        <source>Another sensor is the reference now: {sensor}.</source>
        <translation>Ahora otro sensor es la referencia: {sensor}.</translation>
    </message>
    <message>
        <source>Depth is corrected otherwise since: {sensors}. Calibrate again.</source>
        <translation>La profundidad se corrige ahora de otro modo: {sensors}. Calibre de nuevo.</translation>
    </message>
    <message>
        <source>More is to be taught (samples, pieces of fruit): {kinds}.</source>
        <translation>Falta enseñar más (muestras, frutas): {kinds}.</translation>
    </message>
    <message>
        <source>Teach at least two kinds.</source>
        <translation>Enseñe al menos dos tipos.</translation>
    </message>
    <message>
        <source>The kinds taught are not those of the model ({kinds}).</source>
        <translation>Los tipos enseñados no son los del modelo ({kinds}).</translation>
    </message>
    <message>
        <source>A sensor was moved; calibrate again.</source>
        <translation>Se movió un sensor; calibre de nuevo.</translation>
    </message>
    <message>
        <source>The sensors were calibrated again since.</source>
        <translation>Después se calibraron de nuevo los sensores.</translation>
    </message>
    <message>
        <source>Trained with an earlier calibration.</source>
        <translation>Entrenado con una calibración anterior.</translation>
    </message>
    <message>
        <source>More was taught since it was trained.</source>
        <translation>Se enseñó más desde que se entrenó.</translation>
    </message>
    <message>
        <source>Without a model every fruit counts as unknown.</source>
        <translation>Sin un modelo, toda la fruta cuenta como desconocida.</translation>
    </message>
    <message>
        <source>The line is running.</source>
        <translation>La línea está en marcha.</translation>
    </message>
</context>
<context>
    <name>StoreTrouble</name>
    <message>
        <source>fruitgui: the records cannot be opened</source>
        <translation>fruitgui: no se pueden abrir los registros</translation>
    </message>
    <message>
        <source>The records cannot be opened</source>
        <translation>No se pueden abrir los registros</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>Intentar de nuevo</translation>
    </message>
    <message>
        <source>Try to open the records once more</source>
        <translation>Intentar abrir los registros una vez más</translation>
    </message>
    <message>
        <source>Begin anew</source>
        <translation>Empezar de cero</translation>
    </message>
    <message>
        <source>Keep the damaged file aside, unharmed, and begin an empty one</source>
        <translation>Guardar aparte el archivo dañado, sin tocarlo, y empezar uno vacío</translation>
    </message>
    <message>
        <source>Restore</source>
        <translation>Restaurar</translation>
    </message>
    <message>
        <source>Go back to this backup; what is there now is kept aside</source>
        <translation>Volver a este respaldo; lo que hay ahora se guarda aparte</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Cerrar</translation>
    </message>
    <message>
        <source>Change nothing and end the program</source>
        <translation>No cambiar nada y terminar el programa</translation>
    </message>
    <message>
        <source>Looking for the last good backup …</source>
        <translation>Buscando el último respaldo bueno …</translation>
    </message>
    <message>
        <source>Restoring the backup …</source>
        <translation>Restaurando el respaldo …</translation>
    </message>
    <message>
        <source>The last good backup is of {when}. What was counted after it is kept aside.</source>
        <translation>El último respaldo bueno es del {when}. Lo contado después se guarda aparte.</translation>
    </message>
    <message>
        <source>Restore the backup of {when}</source>
        <translation>Restaurar el respaldo del {when}</translation>
    </message>
    <message>
        <source>There is no good backup in this line&apos;s folder.</source>
        <translation>No hay un respaldo bueno en la carpeta de esta línea.</translation>
    </message>
    <message>
        <source>Nothing was changed, and nothing is lost.</source>
        <translation>No se cambió nada ni se perdió nada.</translation>
    </message>
    <message>
        <source>{file} cannot be renamed. Check that its folder may be written to.</source>
        <translation>No se puede cambiar el nombre de {file}. Revise que se pueda escribir en su carpeta.</translation>
    </message>
</context>
<context>
    <name>TopBar</name>
    <message>
        <source>Light or dark (Ctrl+T)</source>
        <translation>Claro u oscuro (Ctrl+T)</translation>
    </message>
    <message>
        <source>Settings (Ctrl+,)</source>
        <translation>Ajustes (Ctrl+,)</translation>
    </message>
    <message>
        <source>Help (F1)</source>
        <translation>Ayuda (F1)</translation>
    </message>
</context>
</TS>
