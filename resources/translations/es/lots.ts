<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es">
<context>
    <name>FruitDetails</name>
    <message>
        <source>Back</source>
        <translation>Volver</translation>
    </message>
    <message>
        <source>Back to the list</source>
        <translation>Volver a la lista</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>Anterior</translation>
    </message>
    <message>
        <source>The fruit before this one</source>
        <translation>La fruta anterior</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>Siguiente</translation>
    </message>
    <message>
        <source>The next fruit</source>
        <translation>La fruta siguiente</translation>
    </message>
    <message>
        <source>Outline</source>
        <translation>Contorno</translation>
    </message>
    <message>
        <source>Draw the outline that was measured (O); V shows the next picture</source>
        <translation>Dibujar el contorno medido (O); V muestra la imagen siguiente</translation>
    </message>
    <message>
        <source>{kind}, No. {number}</source>
        <translation>{kind}, n.º {number}</translation>
    </message>
    <message>
        <source>{row} of {found}</source>
        <translation>{row} de {found}</translation>
    </message>
</context>
<context>
    <name>FruitPicture</name>
    <message>
        <source>No pictures are kept of this fruit, or they have been deleted with age.</source>
        <translation>De esta fruta no se guardan imágenes, o ya se borraron por antiguas.</translation>
    </message>
    <message>
        <source>depth</source>
        <translation>profundidad</translation>
    </message>
    <message>
        <source>colour</source>
        <translation>color</translation>
    </message>
</context>
<context>
    <name>FruitTable</name>
    <message>
        <source>All kinds</source>
        <translation>Todos los tipos</translation>
    </message>
    <message>
        <source>Which fruit</source>
        <translation>Qué fruta</translation>
    </message>
    <message>
        <source>Which fruit are shown</source>
        <translation>Qué fruta se muestra</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Tipo</translation>
    </message>
    <message>
        <source>Fruit of which kind are shown</source>
        <translation>De qué tipo es la fruta que se muestra</translation>
    </message>
    <message>
        <source>Fruit of the lot; Return opens one, keys 1 to 9 name it</source>
        <translation>Fruta del lote; Intro abre una, las teclas 1 a 9 le dan tipo</translation>
    </message>
    <message>
        <source>No such fruit</source>
        <translation>No hay fruta así</translation>
    </message>
    <message>
        <source>Choose other fruit or another kind above.</source>
        <translation>Elija arriba otra fruta u otro tipo.</translation>
    </message>
    <message>
        <source>{count} fruit</source>
        <translation>{count} frutas</translation>
    </message>
</context>
<context>
    <name>HandBar</name>
    <message>
        <source>It is …</source>
        <translation>Es …</translation>
    </message>
    <message>
        <source>Say of which kind the chosen fruit are (keys 1 to 9, or K)</source>
        <translation>Diga de qué tipo es la fruta elegida (teclas 1 a 9, o K)</translation>
    </message>
    <message>
        <source>Leave out</source>
        <translation>Descartar</translation>
    </message>
    <message>
        <source>Do not count the chosen fruit; they stay in the records (Delete)</source>
        <translation>No contar la fruta elegida; queda en los registros (Supr)</translation>
    </message>
    <message>
        <source>Put back</source>
        <translation>Reponer</translation>
    </message>
    <message>
        <source>Count the chosen fruit after all (Delete)</source>
        <translation>Contar de todos modos la fruta elegida (Supr)</translation>
    </message>
    <message>
        <source>Note …</source>
        <translation>Nota …</translation>
    </message>
    <message>
        <source>Write something on the chosen fruit (N)</source>
        <translation>Anotar algo sobre la fruta elegida (N)</translation>
    </message>
    <message>
        <source>Missed one …</source>
        <translation>Faltó una …</translation>
    </message>
    <message>
        <source>Add a fruit that passed and was not counted; it has no measures (Ins)</source>
        <translation>Agregar una fruta que pasó y no se contó; no tiene medidas (Ins)</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Deshacer</translation>
    </message>
    <message>
        <source>Take the last correction back (Ctrl+Z)</source>
        <translation>Deshacer la última corrección (Ctrl+Z)</translation>
    </message>
    <message>
        <source>Another kind …</source>
        <translation>Otro tipo …</translation>
    </message>
    <message>
        <source>Another kind</source>
        <translation>Otro tipo</translation>
    </message>
    <message>
        <source>What the chosen fruit are:</source>
        <translation>Qué es la fruta elegida:</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Nota</translation>
    </message>
    <message>
        <source>What is to be said of this fruit:</source>
        <translation>Qué hay que decir de esta fruta:</translation>
    </message>
</context>
<context>
    <name>HandingOn</name>
    <message>
        <source>Save the report</source>
        <translation>Guardar el informe</translation>
    </message>
    <message>
        <source>Report (*.pdf)</source>
        <translation>Informe (*.pdf)</translation>
    </message>
    <message>
        <source>Save the table of fruit</source>
        <translation>Guardar la tabla de fruta</translation>
    </message>
    <message>
        <source>Table (*.csv)</source>
        <translation>Tabla (*.csv)</translation>
    </message>
    <message>
        <source>Report on lot {name}</source>
        <translation>Informe del lote {name}</translation>
    </message>
    <message>
        <source>Table of lot {name}</source>
        <translation>Tabla del lote {name}</translation>
    </message>
    <message>
        <source>{path} is written.</source>
        <translation>Se escribió {path}.</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Abrir</translation>
    </message>
    <message>
        <source>lot</source>
        <translation>lote</translation>
    </message>
</context>
<context>
    <name>KindTable</name>
    <message>
        <source>Fruit</source>
        <translation>Fruta</translation>
    </message>
    <message>
        <source>Mean volume</source>
        <translation>Volumen medio</translation>
    </message>
    <message>
        <source>Total volume</source>
        <translation>Volumen total</translation>
    </message>
    <message>
        <source>Total mass</source>
        <translation>Masa total</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Tipo</translation>
    </message>
</context>
<context>
    <name>LotDelegate</name>
    <message>
        <source>{fruit} fruit</source>
        <translation>{fruit} frutas</translation>
    </message>
</context>
<context>
    <name>LotList</name>
    <message>
        <source>At any time</source>
        <translation>En cualquier fecha</translation>
    </message>
    <message>
        <source>Today</source>
        <translation>Hoy</translation>
    </message>
    <message>
        <source>The last 7 days</source>
        <translation>Los últimos 7 días</translation>
    </message>
    <message>
        <source>The last 30 days</source>
        <translation>Los últimos 30 días</translation>
    </message>
    <message>
        <source>This year</source>
        <translation>Este año</translation>
    </message>
    <message>
        <source>Between two days</source>
        <translation>Entre dos días</translation>
    </message>
    <message>
        <source>Search</source>
        <translation>Buscar</translation>
    </message>
    <message>
        <source>Words of a lot&apos;s name or grower (Ctrl+F)</source>
        <translation>Palabras del nombre o del productor de un lote (Ctrl+F)</translation>
    </message>
    <message>
        <source>When</source>
        <translation>Cuándo</translation>
    </message>
    <message>
        <source>When the lots were started</source>
        <translation>Cuándo empezaron los lotes</translation>
    </message>
    <message>
        <source>First day</source>
        <translation>Primer día</translation>
    </message>
    <message>
        <source>The first day on which lots were started</source>
        <translation>El primer día en que empezaron lotes</translation>
    </message>
    <message>
        <source>Last day</source>
        <translation>Último día</translation>
    </message>
    <message>
        <source>The last day on which lots were started</source>
        <translation>El último día en que empezaron lotes</translation>
    </message>
    <message>
        <source>Backup</source>
        <translation>Respaldo</translation>
    </message>
    <message>
        <source>Back up and restore all that is kept (Ctrl+B)</source>
        <translation>Respaldar y restaurar todo lo guardado (Ctrl+B)</translation>
    </message>
    <message>
        <source>Lots</source>
        <translation>Lotes</translation>
    </message>
    <message>
        <source>The lots that were found, the newest first</source>
        <translation>Los lotes encontrados, el más nuevo primero</translation>
    </message>
    <message>
        <source>1 lot</source>
        <translation>1 lote</translation>
    </message>
    <message>
        <source>{count} lots</source>
        <translation>{count} lotes</translation>
    </message>
    <message>
        <source>No lot was found</source>
        <translation>No se encontró ningún lote</translation>
    </message>
    <message>
        <source>Search other words or another time.</source>
        <translation>Busque otras palabras u otra fecha.</translation>
    </message>
    <message>
        <source>No lot yet</source>
        <translation>Todavía no hay lotes</translation>
    </message>
    <message>
        <source>Each lot that is started on the live screen appears here.</source>
        <translation>Aquí aparece cada lote que se inicia en la pantalla En vivo.</translation>
    </message>
</context>
<context>
    <name>LotReport</name>
    <message>
        <source>Reading the lot</source>
        <translation>Leyendo el lote</translation>
    </message>
    <message>
        <source>Lot {name}</source>
        <translation>Lote {name}</translation>
    </message>
    <message>
        <source>Page {page}</source>
        <translation>Página {page}</translation>
    </message>
    <message>
        <source>Report on a lot of fruit</source>
        <translation>Informe de un lote de fruta</translation>
    </message>
    <message>
        <source>Grower</source>
        <translation>Productor</translation>
    </message>
    <message>
        <source>Recipe</source>
        <translation>Receta</translation>
    </message>
    <message>
        <source>Started</source>
        <translation>Inicio</translation>
    </message>
    <message>
        <source>Ended</source>
        <translation>Término</translation>
    </message>
    <message>
        <source>not ended yet</source>
        <translation>aún sin terminar</translation>
    </message>
    <message>
        <source>Ran</source>
        <translation>En marcha</translation>
    </message>
    <message>
        <source>Stood still</source>
        <translation>Detenido</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Nota</translation>
    </message>
    <message>
        <source>Report made</source>
        <translation>Informe hecho</translation>
    </message>
    <message>
        <source>Counts and volumes</source>
        <translation>Cantidades y volúmenes</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Tipo</translation>
    </message>
    <message>
        <source>Fruit</source>
        <translation>Fruta</translation>
    </message>
    <message>
        <source>Share</source>
        <translation>Parte</translation>
    </message>
    <message>
        <source>Mean volume</source>
        <translation>Volumen medio</translation>
    </message>
    <message>
        <source>Total volume</source>
        <translation>Volumen total</translation>
    </message>
    <message>
        <source>Total mass</source>
        <translation>Masa total</translation>
    </message>
    <message>
        <source>All kinds</source>
        <translation>Todos los tipos</translation>
    </message>
    <message>
        <source>Volumes are sums {of}.</source>
        <translation>Los volúmenes son sumas {of}.</translation>
    </message>
    <message>
        <source>Masses are sums {of}, of known density.</source>
        <translation>Las masas son sumas {of}, de densidad conocida.</translation>
    </message>
    <message>
        <source>Volume and mass of a fruit that people gave another kind stay as they were measured: as of the kind that the machine said.</source>
        <translation>El volumen y la masa de una fruta a la que se dio otro tipo quedan como se midieron: como del tipo que dijo la máquina.</translation>
    </message>
    <message>
        <source>Sensors, with the serials of the devices: {sensors}.</source>
        <translation>Sensores, con la serie de cada equipo: {sensors}.</translation>
    </message>
    <message>
        <source>How the fruit are spread</source>
        <translation>Cómo se reparte la fruta</translation>
    </message>
    <message>
        <source>Corrected by hand</source>
        <translation>Corregido a mano</translation>
    </message>
    <message>
        <source>Of {all} fruit, people corrected {count}: they left out {left_out} and gave {named} another kind, or added it. The figures above hold what people said; what the machine said is kept beside it.</source>
        <translation>De {all} frutas, se corrigieron a mano {count}: {left_out} se descartaron y a {named} se les dio otro tipo, o se agregaron. Las cifras de arriba valen según lo dicho por personas; lo que dijo la máquina se guarda al lado.</translation>
    </message>
    <message>
        <source>Nobody corrected anything; all figures are the machine&apos;s.</source>
        <translation>Nadie corrigió nada; todas las cifras son de la máquina.</translation>
    </message>
    <message>
        <source>{count} fruit are of no kind that the machine was taught; they count as unknown.</source>
        <translation>{count} frutas no son de ningún tipo enseñado a la máquina; cuentan como desconocidas.</translation>
    </message>
    <message>
        <source>In doubt</source>
        <translation>En duda</translation>
    </message>
    <message>
        <source>Not seen</source>
        <translation>Lo que no se vio</translation>
    </message>
    <message>
        <source>And {count} shorter ones.</source>
        <translation>Y {count} más cortas.</translation>
    </message>
    <message>
        <source>Fruit No.</source>
        <translation>Fruta n.º</translation>
    </message>
    <message>
        <source>Volume</source>
        <translation>Volumen</translation>
    </message>
    <message>
        <source>The machine said</source>
        <translation>La máquina dijo</translation>
    </message>
    <message>
        <source>A person said</source>
        <translation>Una persona dijo</translation>
    </message>
    <message>
        <source>not seen</source>
        <translation>no la vio</translation>
    </message>
    <message>
        <source>left out</source>
        <translation>descartada</translation>
    </message>
    <message>
        <source>And {count} more; the table of all fruit (CSV) has every one.</source>
        <translation>Y {count} más; la tabla de toda la fruta (CSV) las tiene todas.</translation>
    </message>
    <message>
        <source>How it was measured</source>
        <translation>Cómo se midió</translation>
    </message>
    <message>
        <source>Every fruit was followed over the belt by sensors that see colour and depth, counted once, and measured from all views together: a closed surface through what was seen gives volume, length and diameter. Nothing was weighed; a mass is the volume times the density of its kind, where that is known.</source>
        <translation>Sensores que ven color y profundidad siguieron cada fruta sobre la cinta; cada una se contó una vez y se midió con todas sus vistas juntas: una superficie cerrada a través de lo visto da volumen, largo y diámetro. Nada se pesó; una masa es el volumen por la densidad de su tipo, donde se conoce.</translation>
    </message>
    <message>
        <source>± is half the width of a 95 % interval. In that of totals and means the errors of single fruit average out; what fruit err by together, such as the sensors&apos; scale, the correction of a kind, or its density, does not, and is in it whole.</source>
        <translation>± es la mitad del ancho de un intervalo del 95 %. En el de los totales y las medias, los errores de cada fruta se compensan; lo que todas las frutas yerran juntas, como la escala de los sensores, la corrección de un tipo o su densidad, no se compensa, y está incluido por entero.</translation>
    </message>
    <message>
        <source>Kinds by model {model}; frame of reference: sensor {sensor}.</source>
        <translation>Tipos según el modelo {model}; sistema de referencia: sensor {sensor}.</translation>
    </message>
</context>
<context>
    <name>LotView</name>
    <message>
        <source>Summary</source>
        <translation>Resumen</translation>
    </message>
    <message>
        <source>Counts, volumes and sizes of the lot (Ctrl+1)</source>
        <translation>Cantidades, volúmenes y calibres del lote (Ctrl+1)</translation>
    </message>
    <message>
        <source>Fruit</source>
        <translation>Fruta</translation>
    </message>
    <message>
        <source>Each fruit of the lot, to look at and to correct (Ctrl+2)</source>
        <translation>Cada fruta del lote, para mirarla y corregirla (Ctrl+2)</translation>
    </message>
    <message>
        <source>Lot {name}</source>
        <translation>Lote {name}</translation>
    </message>
    <message>
        <source>Fruit ({count})</source>
        <translation>Fruta ({count})</translation>
    </message>
</context>
<context>
    <name>Lots</name>
    <message>
        <source>ran</source>
        <translation>en marcha</translation>
    </message>
    <message>
        <source>Started {when}</source>
        <translation>Inicio {when}</translation>
    </message>
    <message>
        <source>ended {when}</source>
        <translation>término {when}</translation>
    </message>
    <message>
        <source>ran {time}</source>
        <translation>en marcha {time}</translation>
    </message>
    <message>
        <source>one pause of {time}</source>
        <translation>una pausa de {time}</translation>
    </message>
    <message>
        <source>{count} pauses, together {time}</source>
        <translation>{count} pausas, en total {time}</translation>
    </message>
    <message>
        <source>For {time} ({count}×, {sensors}) fruit may have passed unseen</source>
        <translation>Durante {time} ({count}×, {sensors}) pudo pasar fruta sin ser vista</translation>
    </message>
    <message>
        <source>for {time} ({count}×, {sensors}) sizes are less sure</source>
        <translation>durante {time} ({count}×, {sensors}) los tamaños son menos seguros</translation>
    </message>
    <message>
        <source>for {time} ({count}×, {sensors}) few pictures came, fruit may be missing</source>
        <translation>durante {time} ({count}×, {sensors}) llegaron pocas imágenes, puede faltar fruta</translation>
    </message>
    <message>
        <source>for {time} ({count}×, {sensors}) few pictures came, sizes are less sure</source>
        <translation>durante {time} ({count}×, {sensors}) llegaron pocas imágenes, los tamaños son menos seguros</translation>
    </message>
    <message>
        <source>Moved since calibrated, from {time} on ({sensors}): sizes and counts may be wrong</source>
        <translation>Movido desde la calibración, a partir de las {time} ({sensors}): tamaños y recuentos pueden estar mal</translation>
    </message>
    <message>
        <source>Clocks leapt {count}× ({sensors}): fruit of that moment may be missing or twice</source>
        <translation>Saltaron relojes {count}× ({sensors}): puede faltar fruta de ese momento o estar dos veces</translation>
    </message>
    <message>
        <source>Most fruit were unknown to the model at {times}: kinds may lack fruit</source>
        <translation>El modelo no conocía la mayor parte de la fruta a las {times}: a los tipos puede faltarles fruta</translation>
    </message>
    <message>
        <source>The line broke off at {times} and went on: fruit in view then may be missing</source>
        <translation>La línea se interrumpió a las {times} y siguió: puede faltar la fruta que estaba a la vista</translation>
    </message>
    <message>
        <source>recipe {recipe}</source>
        <translation>receta {recipe}</translation>
    </message>
    <message>
        <source>model {model}</source>
        <translation>modelo {model}</translation>
    </message>
    <message>
        <source>nothing corrected</source>
        <translation>nada corregido</translation>
    </message>
    <message>
        <source>{count} corrected by hand</source>
        <translation>{count} corregidas a mano</translation>
    </message>
    <message>
        <source>{count} of them left out</source>
        <translation>{count} de ellas descartadas</translation>
    </message>
    <message>
        <source>of {some} of {all} fruit</source>
        <translation>de {some} de {all} frutas</translation>
    </message>
    <message>
        <source>The machine missed this fruit; a person added it.</source>
        <translation>La máquina no vio esta fruta; la agregó una persona.</translation>
    </message>
    <message>
        <source>The machine did not know it.</source>
        <translation>La máquina no la conocía.</translation>
    </message>
    <message>
        <source>The machine said {kind}, {sure} sure.</source>
        <translation>La máquina dijo {kind}, con {sure} de seguridad.</translation>
    </message>
    <message>
        <source>A person named it {kind}.</source>
        <translation>Una persona dijo {kind}.</translation>
    </message>
    <message>
        <source>A person left it out; it does not count.</source>
        <translation>Una persona la descartó; no cuenta.</translation>
    </message>
    <message>
        <source>Volume</source>
        <translation>Volumen</translation>
    </message>
    <message>
        <source>uncorrected</source>
        <translation>sin corregir</translation>
    </message>
    <message>
        <source>by the paper</source>
        <translation>según el artículo</translation>
    </message>
    <message>
        <source>Mass</source>
        <translation>Masa</translation>
    </message>
    <message>
        <source>Diameter</source>
        <translation>Diámetro</translation>
    </message>
    <message>
        <source>Length</source>
        <translation>Largo</translation>
    </message>
    <message>
        <source>Perimeter</source>
        <translation>Perímetro</translation>
    </message>
    <message>
        <source>Seen</source>
        <translation>Vista</translation>
    </message>
    <message>
        <source>Counted</source>
        <translation>Contada</translation>
    </message>
    <message>
        <source>Outlet</source>
        <translation>Salida</translation>
    </message>
    <message>
        <source>{views} views</source>
        <translation>{views} vistas</translation>
    </message>
    <message>
        <source>{share} of its surface, {views} views</source>
        <translation>{share} de su superficie, {views} vistas</translation>
    </message>
    <message>
        <source>left out</source>
        <translation>descartada</translation>
    </message>
    <message>
        <source>counts</source>
        <translation>cuenta</translation>
    </message>
    <message>
        <source>All that count</source>
        <translation>Toda la que cuenta</translation>
    </message>
    <message>
        <source>Unknown</source>
        <translation>Desconocida</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>Corregida</translation>
    </message>
    <message>
        <source>Left out</source>
        <translation>Descartada</translation>
    </message>
    <message>
        <source>No.</source>
        <translation>N.º</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Tipo</translation>
    </message>
    <message>
        <source>Sure</source>
        <translation>Certeza</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>Vistas</translation>
    </message>
    <message>
        <source>added by hand</source>
        <translation>agregada a mano</translation>
    </message>
    <message>
        <source>machine: {kind}</source>
        <translation>máquina: {kind}</translation>
    </message>
    <message>
        <source>1 fruit named {kind}.</source>
        <translation>1 fruta pasó a {kind}.</translation>
    </message>
    <message>
        <source>{count} fruit named {kind}.</source>
        <translation>{count} frutas pasaron a {kind}.</translation>
    </message>
    <message>
        <source>1 fruit added: {kind}.</source>
        <translation>1 fruta agregada: {kind}.</translation>
    </message>
    <message>
        <source>1 fruit left out.</source>
        <translation>1 fruta descartada.</translation>
    </message>
    <message>
        <source>{count} fruit left out.</source>
        <translation>{count} frutas descartadas.</translation>
    </message>
    <message>
        <source>1 fruit put back.</source>
        <translation>1 fruta repuesta.</translation>
    </message>
    <message>
        <source>{count} fruit put back.</source>
        <translation>{count} frutas repuestas.</translation>
    </message>
    <message>
        <source>running</source>
        <translation>en marcha</translation>
    </message>
    <message>
        <source>paused</source>
        <translation>en pausa</translation>
    </message>
    <message>
        <source>not ended</source>
        <translation>sin terminar</translation>
    </message>
    <message>
        <source>ended</source>
        <translation>terminado</translation>
    </message>
    <message>
        <source>the program was not running</source>
        <translation>el programa no estaba funcionando</translation>
    </message>
</context>
<context>
    <name>LotsPage</name>
    <message>
        <source>Report …</source>
        <translation>Informe …</translation>
    </message>
    <message>
        <source>A PDF to hand to the grower</source>
        <translation>Un PDF para entregar al productor</translation>
    </message>
    <message>
        <source>Table …</source>
        <translation>Tabla …</translation>
    </message>
    <message>
        <source>All fruit of the lot as CSV</source>
        <translation>Toda la fruta del lote como CSV</translation>
    </message>
    <message>
        <source>Choose a lot at the left.</source>
        <translation>Elija un lote a la izquierda.</translation>
    </message>
    <message>
        <source>Start a lot on the live screen first.</source>
        <translation>Primero inicie un lote en la pantalla en vivo.</translation>
    </message>
    <message>
        <source>No lot is chosen</source>
        <translation>No hay un lote elegido</translation>
    </message>
    <message>
        <source>Choose one at the left: its counts, sizes and fruit appear here.</source>
        <translation>Elija uno a la izquierda: aquí aparecen sus cantidades, calibres y fruta.</translation>
    </message>
    <message>
        <source>Start a lot on the live screen. Its counts, volumes and sizes appear here, every fruit with its pictures, and a report to hand to the grower.</source>
        <translation>Inicie un lote en la pantalla En vivo. Aquí aparecen sus cantidades, volúmenes y calibres, cada fruta con sus imágenes, y un informe para entregar al productor.</translation>
    </message>
    <message>
        <source>Nothing has been run yet</source>
        <translation>Todavía no se ha procesado nada</translation>
    </message>
    <message>
        <source>Look through the fruit, correct what is wrong, then hand on the report.</source>
        <translation>Revise la fruta, corrija lo que esté mal y entregue el informe.</translation>
    </message>
    <message>
        <source>Keys 1 to 9 name the fruit, Delete leaves it out, PgUp and PgDn go through the list.</source>
        <translation>Las teclas 1 a 9 dan el tipo, Supr descarta, RePág y AvPág recorren la lista.</translation>
    </message>
    <message>
        <source>A picture or Return opens a fruit. Keys 1 to 9 name the chosen ones, Delete leaves them out.</source>
        <translation>Una imagen o Intro abre una fruta. Las teclas 1 a 9 dan tipo a las elegidas, Supr las descarta.</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Deshacer</translation>
    </message>
</context>
<context>
    <name>Spreads</name>
    <message>
        <source>Show how the fruit are spread by this measure</source>
        <translation>Mostrar cómo se reparte la fruta según esta medida</translation>
    </message>
    <message>
        <source>Nothing of this was measured in this lot.</source>
        <translation>De esto no se midió nada en este lote.</translation>
    </message>
</context>
<context>
    <name>StoreMenu</name>
    <message>
        <source>Backup</source>
        <translation>Respaldo</translation>
    </message>
    <message>
        <source>{path} holds all of it.</source>
        <translation>{path} contiene todo.</translation>
    </message>
    <message>
        <source>Checking the backup</source>
        <translation>Revisando el respaldo</translation>
    </message>
    <message>
        <source>Back up now</source>
        <translation>Respaldar ahora</translation>
    </message>
    <message>
        <source>Keep a copy of all records in this line&apos;s folder</source>
        <translation>Guardar una copia de todos los registros en la carpeta de esta línea</translation>
    </message>
    <message>
        <source>Back up to …</source>
        <translation>Respaldar en …</translation>
    </message>
    <message>
        <source>Keep a copy somewhere else, for example on a stick</source>
        <translation>Guardar una copia en otro lugar, por ejemplo en un pendrive</translation>
    </message>
    <message>
        <source>Restore a backup …</source>
        <translation>Restaurar un respaldo …</translation>
    </message>
    <message>
        <source>Go back to a copy; nothing runs meanwhile</source>
        <translation>Volver a una copia; mientras tanto nada funciona</translation>
    </message>
    <message>
        <source>Do not restore after all</source>
        <translation>No restaurar</translation>
    </message>
    <message>
        <source>Leave everything as it is at the next start</source>
        <translation>Dejar todo como está en el próximo inicio</translation>
    </message>
    <message>
        <source>Show the folder</source>
        <translation>Mostrar la carpeta</translation>
    </message>
    <message>
        <source>Open the folder that holds this line&apos;s files</source>
        <translation>Abrir la carpeta con los archivos de esta línea</translation>
    </message>
    <message>
        <source>Back up to</source>
        <translation>Respaldar en</translation>
    </message>
    <message>
        <source>Backup (*.zip)</source>
        <translation>Respaldo (*.zip)</translation>
    </message>
    <message>
        <source>A lot is running.</source>
        <translation>Hay un lote en marcha.</translation>
    </message>
    <message>
        <source>End it before you restore a backup.</source>
        <translation>Termínelo antes de restaurar un respaldo.</translation>
    </message>
    <message>
        <source>Which backup?</source>
        <translation>¿Qué respaldo?</translation>
    </message>
    <message>
        <source>Restore a backup</source>
        <translation>Restaurar un respaldo</translation>
    </message>
    <message>
        <source>Restore {name} at the next start?</source>
        <translation>¿Restaurar {name} en el próximo inicio?</translation>
    </message>
    <message>
        <source>Lots, fruit, taught fruit, models and settings go back to what they were then. What is there now is kept in a folder of its own.</source>
        <translation>Lotes, fruta, fruta enseñada, modelos y ajustes vuelven a como estaban entonces. Lo que hay ahora se guarda en una carpeta aparte.</translation>
    </message>
    <message>
        <source>Restore</source>
        <translation>Restaurar</translation>
    </message>
    <message>
        <source>The backup of {when} is whole. Close the window and start again: it is put in place then.</source>
        <translation>El respaldo del {when} está completo. Cierre la ventana e inicie de nuevo: entonces se pone en su lugar.</translation>
    </message>
    <message>
        <source>Close now</source>
        <translation>Cerrar ahora</translation>
    </message>
    <message>
        <source>Everything stays as it is at the next start.</source>
        <translation>En el próximo inicio todo queda como está.</translation>
    </message>
</context>
<context>
    <name>Summary</name>
    <message>
        <source>Fruit</source>
        <translation>Fruta</translation>
    </message>
    <message>
        <source>Total volume</source>
        <translation>Volumen total</translation>
    </message>
    <message>
        <source>Total mass</source>
        <translation>Masa total</translation>
    </message>
    <message>
        <source>no density is known</source>
        <translation>no se conoce ninguna densidad</translation>
    </message>
    <message>
        <source>± is half the width of a 95 % interval. In that of sums and means what single fruit err by averages out; what all err by together (the sensors&apos; scale, a kind&apos;s correction) does not.</source>
        <translation>± es la mitad del ancho de un intervalo del 95 %. En el de sumas y medias, lo que yerra cada fruta se compensa; lo que yerran todas juntas (la escala de los sensores, la corrección de un tipo) no.</translation>
    </message>
</context>
<context>
    <name>WayView</name>
    <message>
        <source>No path is kept of this fruit.</source>
        <translation>De esta fruta no se guarda un recorrido.</translation>
    </message>
    <message>
        <source>→ way over the belt: {length} in {time}</source>
        <translation>→ recorrido en la cinta: {length} en {time}</translation>
    </message>
</context>
</TS>
