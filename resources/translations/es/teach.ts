<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es">
<context>
    <name>Classroom</name>
    <message>
        <source>Named: {kind}.</source>
        <translation>Nombrada: {kind}.</translation>
    </message>
    <message>
        <source>{count} fruit named: {kind}.</source>
        <translation>{count} frutas nombradas: {kind}.</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Deshacer</translation>
    </message>
    <message>
        <source>{count} fruit wait to be named again.</source>
        <translation>Frutas que vuelven a esperar su nombre: {count}.</translation>
    </message>
    <message>
        <source>The measures are kept.</source>
        <translation>Las medidas quedaron guardadas.</translation>
    </message>
    <message>
        <source>{count} fruit were removed.</source>
        <translation>Frutas eliminadas: {count}.</translation>
    </message>
    <message>
        <source>Watching the line</source>
        <translation>Mirando la línea</translation>
    </message>
    <message>
        <source>Watching {name}</source>
        <translation>Mirando {name}</translation>
    </message>
    <message>
        <source>Looking through the fruit</source>
        <translation>Revisando la fruta</translation>
    </message>
    <message>
        <source>{rows} labels of {source} are in {file}.</source>
        <translation>Las {rows} etiquetas de {source} están en {file}.</translation>
    </message>
    <message>
        <source>Writing labels</source>
        <translation>Escribiendo etiquetas</translation>
    </message>
    <message>
        <source>Reading labels</source>
        <translation>Leyendo etiquetas</translation>
    </message>
    <message>
        <source>There is nothing to undo.</source>
        <translation>No hay nada que deshacer.</translation>
    </message>
    <message>
        <source>There is nothing to do again.</source>
        <translation>No hay nada que rehacer.</translation>
    </message>
    <message>
        <source>Taken back on {count} fruit.</source>
        <translation>Deshecho en {count} frutas.</translation>
    </message>
    <message>
        <source>Done again on {count} fruit.</source>
        <translation>Rehecho en {count} frutas.</translation>
    </message>
    <message>
        <source>{count} fruit came in from {source}.</source>
        <translation>Llegaron {count} frutas de {source}.</translation>
    </message>
    <message>
        <source>All {count} fruit of {source} were here already.</source>
        <translation>Las {count} frutas de {source} ya estaban aquí.</translation>
    </message>
    <message>
        <source>The fruit that came in can be named all the same.</source>
        <translation>La fruta que llegó se puede nombrar de todos modos.</translation>
    </message>
    <message>
        <source>{fruit} fruit were named by {rows} labels.</source>
        <translation>Se nombraron {fruit} frutas con {rows} etiquetas.</translation>
    </message>
    <message>
        <source>{count} rows of the file point at no fruit and were left out.</source>
        <translation>{count} filas del archivo no señalan ninguna fruta y se omitieron.</translation>
    </message>
    <message>
        <source>The log says which: open the help, then Show log.</source>
        <translation>El registro dice cuáles: abra la ayuda y luego Ver registro.</translation>
    </message>
</context>
<context>
    <name>DensitiesDialog</name>
    <message>
        <source>Save</source>
        <translation>Guardar</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Cancelar</translation>
    </message>
    <message>
        <source>Density of each kind</source>
        <translation>Densidad de cada tipo</translation>
    </message>
    <message>
        <source>Density of {kind}, g/ml</source>
        <translation>Densidad de {kind}, g/ml</translation>
    </message>
    <message>
        <source>By reference fruit, g/ml</source>
        <translation>Por fruta de referencia, g/ml</translation>
    </message>
    <message>
        <source>Typed, g/ml</source>
        <translation>Escrita, g/ml</translation>
    </message>
    <message>
        <source>A mass is the volume times the density of the kind. Reference fruit of which you measured volume and weight teach it; a number typed here stands instead. Empty leaves it to the reference fruit. It holds from the next lot on.</source>
        <translation>Una masa es el volumen por la densidad del tipo. La enseña la fruta de referencia cuyo volumen y peso midió; un número escrito aquí la reemplaza. Vacío lo deja a la fruta de referencia. Vale desde el próximo lote.</translation>
    </message>
    <message>
        <source>{kind}: a density lies between {least} and {most} g/ml; water has 1.</source>
        <translation>{kind}: una densidad está entre {least} y {most} g/ml; el agua tiene 1.</translation>
    </message>
</context>
<context>
    <name>KindButton</name>
    <message>
        <source>Give this kind to the chosen fruit</source>
        <translation>Dar este tipo a la fruta elegida</translation>
    </message>
    <message>
        <source>{tip}. Density by its reference fruit: {density}</source>
        <translation>{tip}. Densidad según su fruta de referencia: {density}</translation>
    </message>
    <message>
        <source>{samples} views · {fruit} fruit</source>
        <translation>{samples} vistas · {fruit} frutas</translation>
    </message>
    <message>
        <source>{samples}/{views} views · {fruit}/{pieces} fruit</source>
        <translation>{samples}/{views} vistas · {fruit}/{pieces} frutas</translation>
    </message>
</context>
<context>
    <name>KindKeys</name>
    <message>
        <source>New kind …</source>
        <translation>Tipo nuevo …</translation>
    </message>
    <message>
        <source>Name of a new kind</source>
        <translation>Nombre de un tipo nuevo</translation>
    </message>
    <message>
        <source>Type a name and press Enter; the chosen fruit get it (Ctrl+K)</source>
        <translation>Escriba un nombre y presione Entrar; la fruta elegida lo recibe (Ctrl+K)</translation>
    </message>
</context>
<context>
    <name>Shelves</name>
    <message>
        <source>All kinds</source>
        <translation>Todos</translation>
    </message>
    <message>
        <source>Kind to review</source>
        <translation>Tipo que se revisa</translation>
    </message>
    <message>
        <source>Review the fruit of one kind</source>
        <translation>Revisar la fruta de un tipo</translation>
    </message>
    <message>
        <source>Size of the pictures</source>
        <translation>Tamaño de las imágenes</translation>
    </message>
    <message>
        <source>Size of the pictures (+ and −)</source>
        <translation>Tamaño de las imágenes (+ y −)</translation>
    </message>
    <message>
        <source>Fruit that wait to be named (Ctrl+1)</source>
        <translation>Fruta que espera su nombre (Ctrl+1)</translation>
    </message>
    <message>
        <source>Fruit that have a kind, to look over (Ctrl+2)</source>
        <translation>Fruta que ya tiene tipo, para revisarla (Ctrl+2)</translation>
    </message>
    <message>
        <source>Fruit that a model which never saw them takes for something else (Ctrl+3)</source>
        <translation>Fruta que un modelo que nunca la vio toma por otra cosa (Ctrl+3)</translation>
    </message>
    <message>
        <source>Waiting</source>
        <translation>En espera</translation>
    </message>
    <message>
        <source>Named</source>
        <translation>Con tipo</translation>
    </message>
    <message>
        <source>Doubtful</source>
        <translation>Dudosas</translation>
    </message>
</context>
<context>
    <name>SidePanel</name>
    <message>
        <source>Choose a fruit to see it from all sides.</source>
        <translation>Elija una fruta para verla por todos lados.</translation>
    </message>
    <message>
        <source>{count} fruit are chosen; a key names them all.</source>
        <translation>Hay {count} frutas elegidas; una tecla las nombra todas.</translation>
    </message>
    <message>
        <source>Not named yet</source>
        <translation>Aún sin tipo</translation>
    </message>
    <message>
        <source>Estimated</source>
        <translation>Estimado</translation>
    </message>
    <message>
        <source>Volume</source>
        <translation>Volumen</translation>
    </message>
    <message>
        <source>Weight</source>
        <translation>Peso</translation>
    </message>
    <message>
        <source>Measured volume, ml</source>
        <translation>Volumen medido, ml</translation>
    </message>
    <message>
        <source>As measured, for example in water (Ctrl+M)</source>
        <translation>Según se midió, por ejemplo en agua (Ctrl+M)</translation>
    </message>
    <message>
        <source>Measured weight, g</source>
        <translation>Peso medido, g</translation>
    </message>
    <message>
        <source>As weighed</source>
        <translation>Según la balanza</translation>
    </message>
    <message>
        <source>Measure some fruit of each kind: they correct the volumes, and give the density.</source>
        <translation>Mida algunas frutas de cada tipo: corrigen los volúmenes y dan la densidad.</translation>
    </message>
    <message>
        <source>Density of this fruit: {density}</source>
        <translation>Densidad de esta fruta: {density}</translation>
    </message>
    <message>
        <source>Density of its kind: {density}</source>
        <translation>Densidad de su tipo: {density}</translation>
    </message>
</context>
<context>
    <name>Teach</name>
    <message>
        <source>{kind}, or {other}?</source>
        <translation>¿{kind}, o {other}?</translation>
    </message>
    <message>
        <source>Line, {time}</source>
        <translation>Línea, {time}</translation>
    </message>
    <message>
        <source>{fruit} fruit came in, {frames} pictures were looked at</source>
        <translation>Llegaron {fruit} frutas, se miraron {frames} imágenes</translation>
    </message>
    <message>
        <source>Learning from what is named so far</source>
        <translation>Aprendiendo de lo nombrado hasta ahora</translation>
    </message>
</context>
<context>
    <name>TeachActions</name>
    <message>
        <source>Watch the line</source>
        <translation>Mirar la línea</translation>
    </message>
    <message>
        <source>Let fruit pass; nothing is counted</source>
        <translation>Hacer pasar fruta; no se cuenta nada</translation>
    </message>
    <message>
        <source>Open a recording</source>
        <translation>Abrir grabación</translation>
    </message>
    <message>
        <source>Let the fruit of a recording come in</source>
        <translation>Traer la fruta de una grabación</translation>
    </message>
    <message>
        <source>Enough</source>
        <translation>Basta</translation>
    </message>
    <message>
        <source>Stop watching; the fruit that came in stay</source>
        <translation>Dejar de mirar; la fruta que llegó se queda</translation>
    </message>
    <message>
        <source>Suggest</source>
        <translation>Sugerir</translation>
    </message>
    <message>
        <source>Learn from what is named so far: suggest kinds, put first what would teach most, find likely mistakes</source>
        <translation>Aprender de lo nombrado hasta ahora: sugerir tipos, poner primero lo que más enseñaría, hallar fruta dudosa</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Deshacer</translation>
    </message>
    <message>
        <source>Do again</source>
        <translation>Rehacer</translation>
    </message>
    <message>
        <source>Show depth</source>
        <translation>Mostrar profundidad</translation>
    </message>
    <message>
        <source>Let it wait: no kind</source>
        <translation>Dejarla en espera, sin tipo</translation>
    </message>
    <message>
        <source>Remove for good</source>
        <translation>Eliminar para siempre</translation>
    </message>
    <message>
        <source>Density of each kind</source>
        <translation>Densidad de cada tipo</translation>
    </message>
    <message>
        <source>Read a labels file</source>
        <translation>Leer un archivo de etiquetas</translation>
    </message>
    <message>
        <source>Write a labels file</source>
        <translation>Escribir un archivo de etiquetas</translation>
    </message>
</context>
<context>
    <name>TeachPage</name>
    <message>
        <source>Remove for good</source>
        <translation>Eliminar para siempre</translation>
    </message>
    <message>
        <source>Nothing is named yet</source>
        <translation>Aún no hay nada nombrado</translation>
    </message>
    <message>
        <source>Fruit that were given a kind can be looked over here.</source>
        <translation>Aquí se puede revisar la fruta que ya tiene tipo.</translation>
    </message>
    <message>
        <source>Fruit will appear here</source>
        <translation>La fruta aparecerá aquí</translation>
    </message>
    <message>
        <source>Each one comes in once it has left the belt.</source>
        <translation>Cada una llega cuando ha salido de la cinta.</translation>
    </message>
    <message>
        <source>Every fruit has a kind</source>
        <translation>Toda la fruta tiene tipo</translation>
    </message>
    <message>
        <source>Let more fruit pass, or go on to training.</source>
        <translation>Haga pasar más fruta o siga al entrenamiento.</translation>
    </message>
    <message>
        <source>No fruit yet</source>
        <translation>Aún no hay fruta</translation>
    </message>
    <message>
        <source>Watch the line while fruit of each kind pass, or open a recording; each fruit appears here with its picture, and a key says what it is.</source>
        <translation>Mire la línea mientras pasa fruta de cada tipo, o abra una grabación; cada fruta aparece aquí con su imagen, y una tecla dice qué es.</translation>
    </message>
    <message>
        <source>No likely mistakes</source>
        <translation>No hay fruta dudosa</translation>
    </message>
    <message>
        <source>A model that never saw them agrees with every kind given.</source>
        <translation>Un modelo que nunca la vio está de acuerdo con todos los tipos dados.</translation>
    </message>
    <message>
        <source>Nobody looked for mistakes yet</source>
        <translation>Aún no se buscaron errores</translation>
    </message>
    <message>
        <source>Press “Suggest” once some fruit of two kinds are named: each is then judged by a model that never saw it.</source>
        <translation>Presione «Sugerir» cuando haya algo de fruta nombrada de dos tipos: un modelo que nunca la vio juzga cada una.</translation>
    </message>
    <message>
        <source>A lot is running; fruit can be named meanwhile, but none come in until it is ended.</source>
        <translation>Hay un lote en marcha; mientras tanto se puede nombrar fruta, pero no llega ninguna hasta que termine.</translation>
    </message>
    <message>
        <source>Look closely: a key keeps or changes the kind.</source>
        <translation>Mire bien: una tecla conserva o cambia el tipo.</translation>
    </message>
    <message>
        <source>Type the name of the first kind at the top; the chosen fruit get it.</source>
        <translation>Escriba arriba el nombre del primer tipo; la fruta elegida lo recibe.</translation>
    </message>
    <message>
        <source>Press the key of a kind, and go on to the next fruit.</source>
        <translation>Presione la tecla de un tipo y siga con la próxima fruta.</translation>
    </message>
    <message>
        <source>Enough is taught; go on to training.</source>
        <translation>Ya se enseñó lo suficiente; siga al entrenamiento.</translation>
    </message>
    <message>
        <source>No sensor runs: connect them, or open a recording that was made of this line.</source>
        <translation>Ningún sensor funciona: conéctelos o abra una grabación de esta línea.</translation>
    </message>
    <message>
        <source>Let fruit of every kind come in.</source>
        <translation>Haga pasar fruta de todos los tipos.</translation>
    </message>
    <message>
        <source>Choose a fruit first; then a key gives it its kind.</source>
        <translation>Elija primero una fruta; después una tecla le da su tipo.</translation>
    </message>
    <message>
        <source>Remove {count} fruit with their pictures? This cannot be undone.</source>
        <translation>¿Eliminar {count} frutas con sus imágenes? No se puede deshacer.</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Conservar</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Eliminar</translation>
    </message>
    <message>
        <source>Recordings (*.mcap *.bag);;All files (*)</source>
        <translation>Grabaciones (*.mcap *.bag);;Todos los archivos (*)</translation>
    </message>
    <message>
        <source>Choose a recording</source>
        <translation>Elegir una grabación</translation>
    </message>
    <message>
        <source>For which fruit are the labels?</source>
        <translation>¿De qué fruta son las etiquetas?</translation>
    </message>
    <message>
        <source>Choose a labels file</source>
        <translation>Elegir un archivo de etiquetas</translation>
    </message>
    <message>
        <source>Labels (*.csv)</source>
        <translation>Etiquetas (*.csv)</translation>
    </message>
    <message>
        <source>The labels of which fruit?</source>
        <translation>¿Las etiquetas de qué fruta?</translation>
    </message>
    <message>
        <source>Write labels</source>
        <translation>Escribir etiquetas</translation>
    </message>
    <message>
        <source>Labels</source>
        <translation>Etiquetas</translation>
    </message>
</context>
<context>
    <name>TileDelegate</name>
    <message>
        <source>No picture kept</source>
        <translation>Sin imagen guardada</translation>
    </message>
</context>
</TS>
