<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es">
<context>
    <name>CurvePlot</name>
    <message>
        <source>Fruit in training</source>
        <translation>Frutas en el entrenamiento</translation>
    </message>
    <message>
        <source>% right of fruit held out</source>
        <translation>% de aciertos en fruta apartada</translation>
    </message>
</context>
<context>
    <name>MatrixView</name>
    <message>
        <source>Is  ↓     taken for  →</source>
        <translation>Es  ↓     tomada por  →</translation>
    </message>
    <message>
        <source>Right, % (95 %)</source>
        <translation>Aciertos, % (95 %)</translation>
    </message>
</context>
<context>
    <name>MistakesView</name>
    <message>
        <source>{kind}, taken for {other} with {sure}</source>
        <translation>{kind}, tomada por {other} con {sure}</translation>
    </message>
    <message>
        <source>What it was named → what it was taken for, and how surely. A wrong label is put right on the screen “Teach”: choose a fruit and press Enter.</source>
        <translation>Lo que se le dio por nombre → lo que se tomó por ella, y con qué seguridad. Una etiqueta equivocada se corrige en la pantalla «Enseñar»: elija una fruta y presione Entrar.</translation>
    </message>
    <message>
        <source>Not one mistake</source>
        <translation>Ni un error</translation>
    </message>
    <message>
        <source>Every fruit that was held out got the kind that a person gave it.</source>
        <translation>Cada fruta apartada recibió el tipo que una persona le dio.</translation>
    </message>
</context>
<context>
    <name>ResultPanel</name>
    <message>
        <source>Density, ± 95 % between fruit</source>
        <translation>Densidad, ± 95 % entre frutas</translation>
    </message>
    <message>
        <source>Kinds</source>
        <translation>Tipos</translation>
    </message>
    <message>
        <source>Mistakes  {count}</source>
        <translation>Errores  {count}</translation>
    </message>
    <message>
        <source>Learning curve</source>
        <translation>Curva de aprendizaje</translation>
    </message>
    <message>
        <source>Volumes</source>
        <translation>Volúmenes</translation>
    </message>
</context>
<context>
    <name>StartPanel</name>
    <message>
        <source>Few fruit so far: {kinds}. A model can be trained, but show {views} views of {pieces} or more fruit of each kind.</source>
        <translation>Poca fruta hasta ahora: {kinds}. Se puede entrenar un modelo, pero muestre {views} vistas de {pieces} o más frutas de cada tipo.</translation>
    </message>
    <message>
        <source>{made}, in use</source>
        <translation>{made}, en uso</translation>
    </message>
    <message>
        <source>Waits to be accepted: {made}</source>
        <translation>Espera ser aceptado: {made}</translation>
    </message>
    <message>
        <source>What is taught</source>
        <translation>Lo que se enseñó</translation>
    </message>
    <message>
        <source>Models: right on fruit held out (95 %)</source>
        <translation>Modelos: aciertos (95 %)</translation>
    </message>
</context>
<context>
    <name>TaughtView</name>
    <message>
        <source>{fruit} fruit · {samples} views</source>
        <translation>{fruit} frutas · {samples} vistas</translation>
    </message>
</context>
<context>
    <name>Train</name>
    <message>
        <source>Judging fruit that training did not see</source>
        <translation>Juzgando fruta que el entrenamiento no vio</translation>
    </message>
    <message>
        <source>Training on all fruit</source>
        <translation>Entrenando con toda la fruta</translation>
    </message>
    <message>
        <source>Finding out whether more fruit would help</source>
        <translation>Averiguando si ayudaría más fruta</translation>
    </message>
    <message>
        <source>Comparing with the model in use</source>
        <translation>Comparando con el modelo en uso</translation>
    </message>
    <message>
        <source>Checking volumes on fruit left out in turn</source>
        <translation>Comprobando volúmenes con fruta apartada por turno</translation>
    </message>
    <message>
        <source>{kind}: a single fruit cannot be judged by others; show {want} or more.</source>
        <translation>{kind}: una sola fruta no se puede juzgar con otras; muestre {want} o más.</translation>
    </message>
    <message>
        <source>{kind}: {have} fruit teach little; show {want} or more.</source>
        <translation>{kind}: {have} frutas enseñan poco; muestre {want} o más.</translation>
    </message>
    <message>
        <source>{kind}: {have} views are few; show {want} or more.</source>
        <translation>{kind}: {have} vistas son pocas; muestre {want} o más.</translation>
    </message>
    <message>
        <source>There are {most} of {one} but only {least} of {other}; show more of those.</source>
        <translation>Hay {most} de {one} pero solo {least} de {other}; muestre más de esas.</translation>
    </message>
    <message>
        <source>With one kind only, it can tell that from other things, no more.</source>
        <translation>Con un solo tipo puede distinguirlo de otras cosas, nada más.</translation>
    </message>
    <message>
        <source>No fruit could be held out, so nobody knows how good it is.</source>
        <translation>No se pudo apartar ninguna fruta, así que nadie sabe qué tan bueno es.</translation>
    </message>
    <message>
        <source>of {count} fruit that training had not seen got their kind; the true share lies between {low} and {high} %.</source>
        <translation>de {count} frutas que el entrenamiento no había visto recibieron su tipo; el valor verdadero está entre {low} y {high} %.</translation>
    </message>
    <message>
        <source>Better than the model in use</source>
        <translation>Mejor que el modelo en uso</translation>
    </message>
    <message>
        <source>Worse than the model in use</source>
        <translation>Peor que el modelo en uso</translation>
    </message>
    <message>
        <source>As good as the model in use, as far as can be told</source>
        <translation>Tan bueno como el modelo en uso, hasta donde se puede saber</translation>
    </message>
    <message>
        <source>{new} against {old} right of the same {count} fruit.</source>
        <translation>{new} contra {old} aciertos en las mismas {count} frutas.</translation>
    </message>
    <message>
        <source>The one in use may have learned from these very fruit, which flatters it.</source>
        <translation>El que está en uso puede haber aprendido de estas mismas frutas, lo que lo favorece.</translation>
    </message>
    <message>
        <source>The one in use learned from {seen} of them, which flatters it.</source>
        <translation>El que está en uso aprendió de {seen} de ellas, lo que lo favorece.</translation>
    </message>
    <message>
        <source>Neither had seen them.</source>
        <translation>Ninguno las había visto.</translation>
    </message>
    <message>
        <source>Too few fruit to tell whether more would help.</source>
        <translation>Hay muy poca fruta para saber si ayudaría más.</translation>
    </message>
    <message>
        <source>Nearly all are right; more fruit of the same sort would hardly help.</source>
        <translation>Casi todas están bien; más fruta igual apenas ayudaría.</translation>
    </message>
    <message>
        <source>It still got better with more fruit: more of them would likely help.</source>
        <translation>Siguió mejorando con más fruta: es probable que más ayude.</translation>
    </message>
    <message>
        <source>More fruit of the same sort would hardly help; look at the mistakes, or show fruit that look different.</source>
        <translation>Más fruta igual apenas ayudaría; mire los errores o muestre fruta de aspecto distinto.</translation>
    </message>
    <message>
        <source>And {count} more such words: the step before shows how far each kind is.</source>
        <translation>Y {count} avisos más como estos: el paso anterior muestra cuánto falta de cada tipo.</translation>
    </message>
    <message>
        <source>No reference fruit: volumes stay uncorrected. Type the measured volume of some fruit of each kind on the screen “Teach”.</source>
        <translation>Sin fruta de referencia: los volúmenes quedan sin corregir. Escriba el volumen medido de algunas frutas de cada tipo en la pantalla «Enseñar».</translation>
    </message>
    <message>
        <source>Volumes err by {before} % uncorrected and by {after} % corrected, on average over {count} fruit, each corrected by what the others teach.</source>
        <translation>Los volúmenes fallan en {before} % sin corregir y en {after} % corregidos, en promedio sobre {count} frutas, cada una corregida con lo que enseñan las demás.</translation>
    </message>
    <message>
        <source>{count} measures were left out: they cannot be of those fruit.</source>
        <translation>Se omitieron {count} medidas: no pueden ser de esas frutas.</translation>
    </message>
</context>
<context>
    <name>TrainPage</name>
    <message>
        <source>Train</source>
        <translation>Entrenar</translation>
    </message>
    <message>
        <source>Learn from all fruit that have a kind</source>
        <translation>Aprender de toda la fruta que tiene tipo</translation>
    </message>
    <message>
        <source>Accept</source>
        <translation>Aceptar</translation>
    </message>
    <message>
        <source>Name fruit with the new model from now on</source>
        <translation>Nombrar la fruta con el modelo nuevo desde ahora</translation>
    </message>
    <message>
        <source>Keep the old</source>
        <translation>Conservar el anterior</translation>
    </message>
    <message>
        <source>Put the new model away</source>
        <translation>Desechar el modelo nuevo</translation>
    </message>
    <message>
        <source>Roll back</source>
        <translation>Volver atrás</translation>
    </message>
    <message>
        <source>Go back to the model that was in use before</source>
        <translation>Volver al modelo que estaba en uso antes</translation>
    </message>
    <message>
        <source>Look at its label</source>
        <translation>Ver su etiqueta</translation>
    </message>
    <message>
        <source>Go to this fruit on the screen “Teach”</source>
        <translation>Ir a esta fruta en la pantalla «Enseñar»</translation>
    </message>
    <message>
        <source>None yet: every fruit counts as unknown until one is trained and accepted.</source>
        <translation>Aún ninguno: toda la fruta cuenta como desconocida hasta que se entrene y acepte uno.</translation>
    </message>
    <message>
        <source>Nothing to learn from yet</source>
        <translation>Aún no hay de qué aprender</translation>
    </message>
    <message>
        <source>Give fruit their kinds on the screen “Teach”; training then makes the model that names them, and says here how good it is.</source>
        <translation>Dé su tipo a la fruta en la pantalla «Enseñar»; el entrenamiento hace después el modelo que la nombra y dice aquí qué tan bueno es.</translation>
    </message>
    <message>
        <source>Put away</source>
        <translation>Desechar</translation>
    </message>
    <message>
        <source>Train again</source>
        <translation>Entrenar otra vez</translation>
    </message>
    <message>
        <source>This takes some seconds to minutes; other screens can be used meanwhile.</source>
        <translation>Toma de segundos a minutos; mientras tanto se pueden usar otras pantallas.</translation>
    </message>
    <message>
        <source>Teach at least two kinds first.</source>
        <translation>Enseñe primero al menos dos tipos.</translation>
    </message>
    <message>
        <source>A model waits since before: accept it, keep the old one, or train again to see more.</source>
        <translation>Un modelo espera desde antes: acéptelo, conserve el anterior, o entrene de nuevo para ver más.</translation>
    </message>
    <message>
        <source>The model in use knows everything that is taught.</source>
        <translation>El modelo en uso sabe todo lo que se enseñó.</translation>
    </message>
    <message>
        <source>Press Train; nothing changes on the line until the new model is accepted.</source>
        <translation>Presione Entrenar; nada cambia en la línea hasta que se acepte el modelo nuevo.</translation>
    </message>
    <message>
        <source>Without a calibration the model cannot be taken into use.</source>
        <translation>Sin una calibración no se puede usar el modelo.</translation>
    </message>
    <message>
        <source>Look at the kinds and the mistakes, then accept the model.</source>
        <translation>Mire los tipos y los errores, y acepte el modelo.</translation>
    </message>
    <message>
        <source>Compare, then accept the new model or keep the old one.</source>
        <translation>Compare, y acepte el modelo nuevo o conserve el anterior.</translation>
    </message>
</context>
<context>
    <name>Trainer</name>
    <message>
        <source>Training</source>
        <translation>Entrenando</translation>
    </message>
    <message>
        <source>Taking the model into use</source>
        <translation>Poniendo el modelo en uso</translation>
    </message>
    <message>
        <source>The model in use stays; the new one was put away.</source>
        <translation>El modelo en uso se queda; el nuevo se desechó.</translation>
    </message>
    <message>
        <source>It was put away.</source>
        <translation>Se desechó.</translation>
    </message>
    <message>
        <source>Going back to the model before</source>
        <translation>Volviendo al modelo anterior</translation>
    </message>
    <message>
        <source>Training was stopped; nothing was changed.</source>
        <translation>Se detuvo el entrenamiento; no se cambió nada.</translation>
    </message>
    <message>
        <source>The new model is in use from the next lot on.</source>
        <translation>El modelo nuevo se usa desde el próximo lote.</translation>
    </message>
    <message>
        <source>The new model is in use.</source>
        <translation>El modelo nuevo está en uso.</translation>
    </message>
    <message>
        <source>Roll back</source>
        <translation>Volver atrás</translation>
    </message>
    <message>
        <source>The model before is in use again.</source>
        <translation>El modelo anterior está en uso otra vez.</translation>
    </message>
</context>
<context>
    <name>VolumePlot</name>
    <message>
        <source>Measured volume, ml</source>
        <translation>Volumen medido, ml</translation>
    </message>
    <message>
        <source>Estimated volume, ml</source>
        <translation>Volumen estimado, ml</translation>
    </message>
    <message>
        <source>uncorrected</source>
        <translation>sin corregir</translation>
    </message>
    <message>
        <source>corrected, ± 95 %</source>
        <translation>corregido, ± 95 %</translation>
    </message>
</context>
</TS>
